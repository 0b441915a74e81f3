// hull_candidates: the points of a cloud that can be corners of its hull, found without building it.
//
// A small polytope inside the cloud is taken from points that are extreme in a sample. Its gauge (the largest
// of a . x over its facets, 1 on its surface) is looked up in a map of directions: a cell of the map knows
// the few facets that can be the largest in it. What the gauge puts inside is no corner. The farthest point
// in each cell makes a larger polytope for a second pass.
//
// The sample is chosen by a hash of the coordinates, so the candidates do not depend on the order of the
// points; what lies farthest out of the sample's frame joins it, so that one mast on flat ground is seen.
#pragma once

#include "lib/formats/vec.h"

#include <span>
#include <vector>

namespace copse {

// Distinct, in lexicographic order; their hull holds every point. `points`: of a PointCloud. O(n): some 30 ns
// a point and a few ms; sorting what is left.
std::vector<Double3> hull_candidates(std::span<const Double3> points);

}  // namespace copse
