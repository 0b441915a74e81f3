// hull_candidates: the points of a cloud that can be corners of its hull, found without building it; and
// fewer of them when they are too many.
//
// A small polytope inside the cloud is taken from points that are extreme in a sample. Its gauge (the largest
// of a . x over its facets, 1 on its surface) is looked up in a map of directions: a cell of the map knows
// the few facets that can be the largest in it. What the gauge puts inside is no corner. The farthest point
// in each cell makes a larger polytope for a second pass.
//
// The sample is chosen by a hash of the coordinates, so the candidates do not depend on the order of the
// points.
#pragma once

#include "lib/formats/vec.h"

#include <cstddef>
#include <span>
#include <vector>

namespace copse {

struct HullCandidates {
  // Distinct, in lexicographic order; their hull holds every point.
  std::vector<Double3> all;
  // `all`, or where those are more than the limit the farthest in each direction of a map of as many cells.
  std::vector<Double3> chosen;
};

// Points of a PointCloud. O(n): some 30 ns a point and a few ms; sorting what is left.
HullCandidates hull_candidates(std::span<const Double3> points, std::size_t limit);

}  // namespace copse
