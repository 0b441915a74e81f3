// How far the surface of a trunk is from the generalized cylinders that were recovered from it.
#pragma once

#include "lib/analysis/rings/hierarchy.h"
#include "lib/analysis/surface/trunk_mesh.h"

#include <cstdint>
#include <vector>

namespace copse {

// A distribution of one error over the surface, weighted by area.
struct ErrorDistribution {
  double mean = 0, rms = 0, p95 = 0, max = 0;
};

// Each explained triangle is sampled at its three corners. A sample's error is the distance, at right angles
// to the axis, between it and the cone frustum whose ends are the segment's two radii (mean diameters). On a
// tube whose rings are regular polygons the error is zero: it measures what replacing rings by circles gives
// away.
struct CylinderError {
  ErrorDistribution
      of_radius;  // as a share of the local radius; where the radius is 0, the distance is left out
  ErrorDistribution of_height;  // as a share of `height`
  double explained_triangles =
      1;  // share of the trunk's triangles that some segment explains; 1 when there are none
  double explained_area = 1;  // the same by area
};

// Cost: O(n log n) in the explained triangles (the percentile sorts).
CylinderError cylinder_error(const TrunkMesh& trunk, const Hierarchy& hierarchy, double height);

}  // namespace copse
