// Shadow maps for what a camera sees near by: the view is cut along its line of sight into slices, ever
// longer ones, and each gets a map of its own, so that a texel is about as large on screen everywhere.
//
// Source: parallel-split shadow maps (Zhang and others, "Parallel-split shadow maps for large-scale virtual
// environments", 2006): borders halfway between equal ratios and equal steps. A map is as wide as the sphere
// round its slice and moves in whole texels, so that shadows stand still while the camera turns and walks
// (Valient, "Stable rendering of cascaded shadow maps", 2008).
#pragma once

#include "lib/runtime/camera.h"

#include <array>
#include <cstddef>

namespace copse {

inline constexpr std::size_t k_max_cascades = 4;

struct ShadowCascade {
  double begin = 0, end = 0;  // of its slice, metres along the line of sight
  Mat4 clip;                  // relative to the origin -> the light's clip space
  Frustum casters;  // what may cast into its map (relative to the eye, as of frustum_of): all of the
                    // scene that is towards the sun from what the map shows
  double width = 0, depth = 0;  // of the map, metres
};

struct ShadowCascades {
  std::array<ShadowCascade, k_max_cascades> cascades{};
  std::size_t count = 0;  // nearest first
  bool whole = false;     // the last one holds the whole scene: beyond it nothing is in shadow
};

struct CascadeWish {
  std::size_t count = k_max_cascades;  // 1 to k_max_cascades
  int texels = 2048;                   // along a side of a map
  double nearest = 1,
         farthest = 100;  // where the first slice begins and the last one ends; 0 < nearest < farthest
};

// `sun`: towards it, length 1, y > 0. `scene`: all that casts or receives; not empty. Where one map of the
// whole scene is no coarser than that of a slice it takes the place of that and all behind it.
ShadowCascades shadow_cascades(const View& view, const Double3& sun, const DoubleBox& scene,
                               const Double3& origin, const CascadeWish& wish);

}  // namespace copse
