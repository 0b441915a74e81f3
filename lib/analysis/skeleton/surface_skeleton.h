// surface_skeleton: the hierarchy of a surface that has no rings, along its curve skeleton.
#pragma once

#include "lib/analysis/rings/hierarchy.h"
#include "lib/analysis/skeleton/curve_skeleton.h"
#include "lib/analysis/surface/surface.h"

namespace copse {

enum class SkeletonMethod : std::uint8_t {
  levels,  // levels of the distance to the lowest end (level_skeleton.h): linear, needs no repair
  flow,    // mean-curvature flow of the closed surface (flow_skeleton.h)
};

// Radii (RadiusSource::surface) are put along the limbs of the skeleton (skeleton_limbs.h): at ends, at
// forks, and between them every k_sample_spacing radii; each is moved to the centre of the plane section at
// right angles to the limb, whose circle (section.h) gives its diameter; those that their neighbours imply
// are left out. Every vertex belongs to one radius, every triangle is explained by one segment where there is
// one. At least one radius where there is a triangle; two where the surface has any extent. Deterministic.
// O(n log n) with levels.
Hierarchy surface_skeleton(const Surface& surface, SkeletonMethod method = SkeletonMethod::levels);

// The same from a curve skeleton of that surface.
Hierarchy hierarchy_along(const Surface& surface, const CurveSkeleton& skeleton);

}  // namespace copse
