// minimal_box: the oriented box of least volume, and how small any oriented box must be.
//
// The search starts from the world's axes, spreads, the longest distance, large facets and a fixed set of
// rotations, and descends from the best of them: simplex steps over rotations (Nelder, Mead 1965) scaled to
// the box, and the minimal rectangle across each axis in turn (exact, rotating calipers). The lower bound
// comes from box_bound and may send the search to a place it has missed. The same hull gives the same bits,
// every run.
#pragma once

#include "lib/analysis/hull/convex_hull.h"
#include "lib/analysis/hull/deadline.h"
#include "lib/analysis/volumes/bounded_fit.h"
#include "lib/formats/volumes/volume.h"

#include <cstdint>
#include <limits>

namespace copse {

struct MinimalBoxOptions {
  // Stop when the volume is proven to be at most (1 + gap) times the least. Infinity: the hull's volume is
  // the only bound that is given.
  double gap = std::numeric_limits<double>::infinity();
  // The gap is given up when so many cells of rotations have been bounded (some 10^5 a second) ...
  std::size_t max_cells = 2'000'000;
  // ... or at this time. The search comes to an end then too, but never without a box.
  Deadline deadline = {};
};

// Flat clouds get their exact minimal rectangle, thickness as measured, and bound 0. In cloud coordinates.
BoundedFit<OrientedBox<double>> minimal_box(const ConvexHull& hull, const MinimalBoxOptions& options = {});

}  // namespace copse
