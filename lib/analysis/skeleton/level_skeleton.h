// level_skeleton: the curve skeleton of a surface from the levels of its distance to one end (a Reeb graph).
#pragma once

#include "lib/analysis/skeleton/curve_skeleton.h"
#include "lib/analysis/surface/geodesic.h"
#include "lib/analysis/surface/surface.h"

namespace copse {

// The end that distances are measured from: the border through the lowest vertex, or all vertices about as
// low as it where it lies on no border.
std::vector<std::uint32_t> lowest_end(const Surface& surface, const Lists& triangles_of);

// Cuts the surface into slices of equal distance from `sources`; a point of the skeleton is a connected piece
// of a slice (its contour's centre; the mean where it has none), an edge joins pieces that touch. Open
// borders, edges of many triangles and flipped triangles need no repair. The slices are as thin as a number
// of pieces that is linear in the triangles allows. O(n log n).
CurveSkeleton level_skeleton(const Surface& surface, const Lists& triangles_of,
                             std::span<const std::uint32_t> sources);

}  // namespace copse
