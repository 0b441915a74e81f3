// hull_loss: which points are outside a polytope, and how far.
#pragma once

#include "lib/analysis/hull/convex_hull.h"

#include <span>
#include <vector>

namespace copse {

struct HullLoss {
  double distance = 0;            // an upper bound of the largest from the hull; 0 when none is outside
  std::vector<Double3> outside;   // the points that are not certainly inside, in their order
  std::vector<Double3> farthest;  // of those that are outside, of each facet the one farthest out of it
};

// Of the hull of dimension 3 (of `vertices`, `faces`, `edges`). Walks from facet to facet towards the one
// that the ray from the middle to the point leaves by: on a convex polytope no such walk ends too early.
// (Triangles of one plane count as one facet.) O(points) when neighbours follow each other and facets have
// few sides.
HullLoss hull_loss(const ConvexHull& hull, std::span<const Double3> points);

}  // namespace copse
