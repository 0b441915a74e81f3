// swept_descent: from a frame to a capsule or lozenge around all points whose volume no small change lowers.
//
// The optimum is held by a handful of points, so swept_barrier works on a few and the others are looked
// through for those that stick out, until none does. O(points) a round, some three rounds.
#pragma once

#include "lib/analysis/swept/swept_barrier.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace copse {

struct DescentOptions {
  double gap = 1e-8;  // of the log of the volume, to the local optimum
  int rounds = 60;    // of adding points, at most: rings that touch all along need some thirty
  // Of the first barrier. Wide, a descent comes to an end from anywhere, but is carried out of the valley
  // that it starts in.
  double first_gap = 1;
  // The descent is given up when it cannot come below this cost, as far as the barrier's gap tells.
  double hopeless = std::numeric_limits<double>::infinity();
};

// What a fit is judged by: the volume, of a line the radius.
double cost_of(Swept kind, const SweptFit& fit);

// The rectangle about the points in `frame` with the least h-range: what to start from. Encloses strictly.
SweptRectangle roomy_rectangle(Swept kind, std::span<const Double3> points, const Axes& frame);

// A few points that are extreme in the directions of the frame and between them, ascending.
std::vector<std::uint32_t> extreme_points(std::span<const Double3> points, const Axes& frame);

// The largest distance of a point from the rectangle, radius aside.
double reach_of(std::span<const Double3> points, const SweptFit& fit);

class SweptDescent {
 public:
  // `points`: at least one, |p| about 1 or less; they must outlive it.
  SweptDescent(Swept kind, std::span<const Double3> points, const Axes& start);
  // From a rectangle in that frame, whose radius need not reach all points; a capsule's and a line's b0 = b1.
  // `room`: by how much of the radius it then reaches beyond them.
  SweptDescent(Swept kind, std::span<const Double3> points, const SweptFit& start, double room);

  // Called again, with a smaller gap, it goes on from where it has ended.
  void run(const DescentOptions& options = {});

  // Every point is within rectangle.r of the rectangle, but for the rounding of the distance.
  SweptFit fit() const;
  const Axes& frame() const { return fit_.frame; }
  double cost() const { return cost_of(kind_, fit()); }
  // About what going on can bring the cost down to: the points that it works on hold it there.
  double least_cost() const;

 private:
  bool is_done(const DescentOptions& options) const;
  void add_points(const DescentOptions& options);

  Swept kind_;
  std::span<const Double3> points_;
  std::vector<std::uint32_t> working_;
  SweptFit fit_;      // round the points that it works on
  double reach_ = 0;  // of all points; 0 before the first round
  BarrierGaps gaps_;
};

// The whole of it.
SweptFit descend_around(Swept kind, std::span<const Double3> points, const Axes& start,
                        const DescentOptions& options = {});

}  // namespace copse
