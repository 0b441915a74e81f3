// swept_barrier: a log-barrier Newton method for the two small problems that fitting a capsule or a lozenge
// consists of, each over a working set of a few points.
//
// - Descent: turn the frame and move the rectangle so that the volume falls, to a local minimum. Rotations
// and
//   second derivatives are exact.
// - Separation: how far must given lengths grow, along a given direction of lengths, until in some frame of a
//   cell of rotations they hold the points? Rotations are linearised, which makes it convex. The forces with
//   which the points press on the volume at the optimum are the dual solution; force_plane.h makes a bound of
//   them that needs no linearisation.
//
// Source: Boyd and Vandenberghe, "Convex Optimization" (2004), section 11.3. A Newton step over m points
// costs about 100 m + 1000 multiplications; there are some 20 to 40 of them.
#pragma once

#include "lib/analysis/swept/swept_shape.h"

#include <span>
#include <vector>

namespace copse {

// The objective (the log of the volume; s) is brought from within `first_gap` of its optimum, in the theory
// of the central path, to within `last_gap`. Rounding may end that early.
struct BarrierGaps {
  double first = 1, last = 1e-8;
};

struct SweptFit {
  Axes frame;
  SweptRectangle rectangle;
  double volume() const { return swept_volume(rectangle.lengths()); }
};

// `fit` holds every point strictly (distance from the rectangle < r, lengths > 0; a capsule's and a line's
// b0 = b1), and does so afterwards; its volume (of a line, the radius) is not larger.
void descend(Swept kind, std::span<const Double3> points, SweptFit& fit, const BarrierGaps& gaps);

struct Separation {
  SweptLengths from, along;  // lengths = from + s along, s >= 0
  // The cell: |rows[k] . g| <= half[k] for the Cayley vector g of the turn (g.x = 0 for a capsule).
  std::array<Double3, 3> rows;
  Double3 half;
};

struct SeparationState {
  double s = 0;
  Double3 turn;              // Cayley vector
  SweptRectangle rectangle;  // with lengths from + s along
  std::vector<Double3> forces;
};

// `points` are in the frame of the cell's centre. On entry state.s is so large that a rectangle about the
// middle of the points holds them all; only s is read.
void separate(Swept kind, std::span<const Double3> points, const Separation& problem, const BarrierGaps& gaps,
              SeparationState& state);

// q where the linearised turn brings it.
inline Double3 linearly_turned(const Double3& q, const Double3& g) {
  return q + cross(g, q) * 2;
}

}  // namespace copse
