// How far the surface of a trunk is from the generalized cylinders that were recovered from it.
#pragma once

#include "lib/analysis/rings/hierarchy.h"
#include "lib/analysis/surface/trunk_mesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace copse {

// A distribution of one error over the surface, weighted by area.
struct ErrorDistribution {
  double mean = 0, rms = 0, p95 = 0, max = 0;
};

// A triangle counts as explained when a segment owns it and no corner of it is farther from that segment's
// surface than this share of the segment's larger radius.
inline constexpr double k_explained_within = 0.5;

// Every triangle that a segment owns is sampled at its corners, the middles of its sides and its own middle,
// with the weights of the rule that is exact for cubics (1/20, 2/15 and 9/20 of its area). A sample's error
// is its distance from the surface of the cone frustum, end discs included, whose ends are the segment's two
// radii (mean diameters). Rings need not stand at right angles to the axis (an end that is cut level, a tube
// that generators shear): between two rings that were read from the mesh (RadiusSource::ring or point) and
// hold all corners of a triangle, the circles stand as the rings do, and the lesser distance counts. So it
// holds what replacing rings by circles gives away: 1 - cos(pi / k) of the
// radius at the middle of a side of a regular ring of k.
struct CylinderError {
  ErrorDistribution
      of_radius;  // as a share of the local radius; where the radius is 0, the distance is left out
  ErrorDistribution of_height;     // as a share of `height`
  double explained_triangles = 1;  // share of the trunk's triangles; 1 when there are none
  double explained_area = 1;       // the same by area
};

// The 95th percentile is at most 1.1 % too high. O(triangles); memory: 4 bytes a vertex. `every`: looks at
// the first of so many triangles alone, for a quick answer; at least 1.
CylinderError cylinder_error(const TrunkMesh& trunk, const Hierarchy& hierarchy, double height,
                             std::size_t every = 1);

}  // namespace copse
