// The GLSL of treeplay. Colours are linear light; the frame is sRGB.
//
// Three frames of reference: "local" is relative to the tree's origin (float, exact enough for one tree),
// "relative" is local plus `offset` = origin - eye (what the GPU projects), and clip space.
#pragma once

#include <string_view>

namespace copse::treeplay::shaders {

// Put in front of every fragment shader: hash, tone curve, sky, sunlight through the shadow maps, light of
// the sky grid, haze.
extern const std::string_view k_common;

// Behind k_common in front of what fades from one level into the next.
extern const std::string_view k_fade;

extern const std::string_view k_surface_vertex;
extern const std::string_view k_coverage_fragment;  // first pass: depth and alpha only
extern const std::string_view k_surface_fragment;   // second pass: light, where the depth is equal
extern const std::string_view k_shadow_vertex;
extern const std::string_view k_shadow_fragment;

extern const std::string_view k_impostor_vertex;
extern const std::string_view k_impostor_common;  // in front of the two below, behind k_common
extern const std::string_view k_impostor_coverage_fragment;
extern const std::string_view k_impostor_light_fragment;
extern const std::string_view k_picture_vertex;
extern const std::string_view k_picture_coverage_fragment;  // casts shadows as well
extern const std::string_view k_picture_light_fragment;

extern const std::string_view k_line_vertex;
extern const std::string_view k_line_fragment;
extern const std::string_view k_disc_vertex;
extern const std::string_view k_disc_fragment;
extern const std::string_view k_sphere_vertex;
extern const std::string_view k_sphere_fragment;

extern const std::string_view k_ground_vertex;
extern const std::string_view k_ground_fragment;
extern const std::string_view k_screen_vertex;  // a triangle over the whole image
extern const std::string_view k_backdrop_fragment;
extern const std::string_view k_resolve_fragment;  // samples and sub-pixels to pixels

}  // namespace copse::treeplay::shaders
