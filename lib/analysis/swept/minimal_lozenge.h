// minimal_lozenge: the lozenge (rectangle swept by a ball) of least volume, and how small any lozenge must
// be.
//
// Frame, sides, height and radius are searched together (swept_search.h), and the lower bound comes from
// branch and bound over frames (swept_bound.h), which may send the search to a place that it has missed. The
// same hull gives the same bits, every run.
#pragma once

#include "lib/analysis/hull/convex_hull.h"
#include "lib/analysis/swept/swept_bound.h"
#include "lib/analysis/volumes/bounded_fit.h"
#include "lib/formats/volumes/volume.h"

namespace copse {

// In cloud coordinates; holds hull.boundary. Never worse than gaussian_lozenge of the hull's vertices or than
// `capsule`, which holds the boundary too: the minimal capsule, which is never worse than the minimal ball.
// Flat clouds get a rectangle, thickness as measured, and bound 0. About 7 ms for 300 vertices, and 50 more
// for a gap of 0.02.
BoundedFit<Lozenge<double>> minimal_lozenge(const ConvexHull& hull, const Capsule<double>& capsule,
                                            const SweptBoundOptions& options = {});

// With the minimal capsule found first.
BoundedFit<Lozenge<double>> minimal_lozenge(const ConvexHull& hull, const SweptBoundOptions& options = {});

}  // namespace copse
