// box_bound: how small any oriented box round given vertices must be, by branch and bound over rotations.
//
// A cell is a box of Rodrigues vectors c + d about a frame; all frames (up to the 24 that name the same box)
// are |x|, |y|, |z| <= tan(pi / 8), |x| + |y| + |z| <= 1. For any two vertices with difference e and any turn
// r relative to the cell's middle frame, the width along the turned axis u satisfies
//     (1 + |r|^2) width >= e . u + 2 r . (u x e) + terms of second order in r,
// which is affine in r once those are replaced by their least value in the cell. Any convex combination over
// pairs of vertices is such a bound too; the product of three is log-concave, so its least value over the
// cell is at a corner. Combining pairs makes the bound flat where the volume has a crease, which is where
// minima are. Cells are halved, the least bound first.
//
// Rounding is accounted for by 1e-14 of the length of every pair.
#pragma once

#include "lib/analysis/hull/deadline.h"
#include "lib/analysis/hull/frame.h"

#include <cstddef>
#include <functional>
#include <limits>
#include <span>

namespace copse {

struct BoxBoundOptions {
  double gap = 0.01;
  std::size_t max_cells = 2'000'000;
  Deadline deadline = {};
  // Called with a frame whose box is smaller than the smallest known; may improve it and gives the volume.
  std::function<double(const Axes&, double volume)> improve;
};

struct BoxBound {
  double lower_bound = 0;
  std::size_t cells = 0;
};

// `base`: a frame to lay the cells about, best that of a small box; `volume`: of the smallest box known.
// Vertices within 4 of the origin. Ends when the volume is at most (1 + gap) times the bound, or at a limit.
BoxBound box_bound(std::span<const Double3> vertices, const Axes& base, double volume,
                   const BoxBoundOptions& options);

}  // namespace copse
