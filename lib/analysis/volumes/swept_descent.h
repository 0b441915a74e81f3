// swept_descent: from a frame to a capsule or lozenge around all points whose volume no small change lowers.
//
// The optimum is held by a handful of points, so swept_barrier works on a few and the others are looked
// through for those that stick out, until none does. O(points) a round, some three rounds.
#pragma once

#include "lib/analysis/volumes/swept_barrier.h"

#include <cstdint>

namespace copse {

struct DescentOptions {
  double gap = 1e-8;  // of the log of the volume, to the local optimum
  int rounds = 60;    // of adding points, at most: rings that touch all along need some thirty
};

// The rectangle about the points in `frame` with the least h-range: what to start from. Encloses strictly.
SweptRectangle roomy_rectangle(Swept kind, std::span<const Double3> points, const Axes& frame);

// A few points that are extreme in the directions of the frame and between them, ascending.
std::vector<std::uint32_t> extreme_points(std::span<const Double3> points, const Axes& frame);

// The largest distance of a point from the rectangle, radius aside.
double reach_of(std::span<const Double3> points, const SweptFit& fit);

// `points`: at least one, |p| about 1 or less. Every point is within rectangle.r of the rectangle, but for
// the rounding of the distance.
SweptFit descend_around(Swept kind, std::span<const Double3> points, const Axes& start,
                        const DescentOptions& options = {});

}  // namespace copse
