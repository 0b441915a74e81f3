// hull_loss: how far points are outside a polytope.
#pragma once

#include "lib/analysis/hull/convex_hull.h"

#include <span>

namespace copse {

// An upper bound of the largest distance of a point from the hull; 0 when none is outside.
//
// Of the hull of dimension 3 (of `vertices`, `faces`, `edges`). Walks from facet to facet towards the one
// that the ray from the middle to the point leaves by: on a convex polytope no such walk ends too early.
// (Triangles of one plane count as one facet.) O(points) when neighbours follow each other and facets have
// few sides.
double hull_loss(const ConvexHull& hull, std::span<const Double3> points);

}  // namespace copse
