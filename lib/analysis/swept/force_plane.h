// force_plane: a linear inequality between the lengths of every capsule or lozenge, in whatever frame, that
// holds some points; and its least right side over a cell of rotations.
//
// Let forces y_i with sum 0, in the volume's own axes, act on the points P_i. A volume with frame R holds the
// points, so y_i . R P_i is at most its extent in the direction y_i; summed, with a0 and a1, b0 and b1, h
// cancelling as far as the forces balance:
//
//     alpha a + beta b + gamma r >= sum y_i . R P_i = <R, M>,   M = sum y_i P_i^T,
//     alpha = sum |y_i.x| / 2,  beta = sum |y_i.y| / 2,  gamma = sum |y_i|.
//
// It is true for any balanced forces; the dual solution of a separation makes it tight. Nothing is
// linearised: for R = R(g) F with the Cayley vector g, (1 + g.g) <R, M> is a quadratic polynomial in g.
#pragma once

#include "lib/analysis/swept/swept_shape.h"

#include <cstdint>
#include <span>

namespace copse {

struct ForcePlane {
  double alpha = 0, beta = 0, gamma = 0;
  std::array<Double3, 3> moment;  // row k: sum of y_i[k] P_i
  // What all roundings together can amount to, for volumes whose rectangle lies within the points' reach of
  // the origin (which loses none: a rectangle can be cut to the box of the points in its frame).
  double slack = 0;
};

// `forces` on points[which[i]], in the volume's axes; they are made to balance.
ForcePlane force_plane(std::span<const Double3> points, std::span<const std::uint32_t> which,
                       std::span<const Double3> forces);

// Rotations R(g) frame with low <= g <= high.
struct RotationCell {
  Axes frame;
  Double3 low, high;
  Double3 centre() const { return (low + high) * 0.5; }
};

struct PlaneRange {
  double least = 0;  // proven: of <R, M> over the cell, less the slack
  Double3 drop;      // how far each coordinate's extent takes it below the value at the centre, about
};
PlaneRange range_over(const ForcePlane& plane, const RotationCell& cell);

}  // namespace copse
