// swept_bound: a proven lower bound of the volume of every capsule, or every lozenge, that holds some points;
// branch and bound over the rotations.
//
// Directions (capsules) fill a disc of Cayley vectors, frames modulo the rotations of a rectangle (lozenges)
// three cubes. In a cell the inequalities of force_plane.h, with their right sides least over the cell, bound
// a polytope of lengths, whose least vertex bounds the volume. While that vertex is too small a separation
// cuts it off, or proves that no inequality can: then the cell is halved. Derivation: docs/swept.md.
#pragma once

#include "lib/analysis/hull/deadline.h"
#include "lib/analysis/swept/swept_descent.h"

#include <cstddef>
#include <limits>

namespace copse {

struct SweptBoundOptions {
  // Stop when the volume is at most (1 + gap) times the bound. Infinity: nothing is to be proven.
  double gap = std::numeric_limits<double>::infinity();
  // The gap is given up after so many separations (some 10^4 a second; the same result on every machine) ...
  std::size_t max_separations = 200'000;
  // ... or at this time.
  Deadline deadline = {};
  // Proven: no radius is smaller (inner_radius of the hull). Without it frames that lie askew to a needle can
  // only be ruled out one by one.
  double least_radius = 0;
};

struct SweptBound {
  double lower_bound = 0;
  std::size_t separations = 0, cells = 0;
};

// `points`: hull vertices in canonical order, |p| about 1 or less. `best` holds them all; it is replaced when
// a cell leads to a better one. A capsule or a lozenge, not a line.
SweptBound bound_swept(Swept kind, std::span<const Double3> points, const SweptBoundOptions& options,
                       SweptFit& best);

}  // namespace copse
