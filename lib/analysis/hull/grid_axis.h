// grid_axis: the two ends of an axis as numbers of so many bits, chosen so that the line through them keeps
// its direction and its place.
//
// Rounded each to the nearest, the ends of a needle move the line by half a unit across it, which can be more
// than the needle is thick, and ends that are near to one another, of a disc, turn it by as much as half a
// unit over the length between them. But a line passes near many points of the grid: a little beyond the end
// one is a hundred times nearer. Ends that are `n` units apart can keep a direction to about n^-3/2.
//
// So is b - a a number of so many bits, and a capsule is, number by number, a lozenge of one edge.
#pragma once

#include "lib/formats/vec.h"

namespace copse {

struct GridAxis {
  Double3 a, b;  // they and b - a have components of `bits` bits (and no denormals of such numbers)
};

struct AxisToRound {
  Double3 low;        // its end
  Double3 direction;  // unit
  double length = 0;  // from `low` along the direction, from 0
  double radius = 0;  // of what is round the axis, which grows by what the line is moved
  // How far across the line reaches what must stay between the planes through the ends; 0: only the distance
  // from the line between the ends matters (capsules).
  double reach = 0;
};

// bits: 24 (float32) or 53. The ends lie as far apart as `length` and a little more: what they add to the
// volume r^2 (length + 4/3 r of a capsule) is about the least of some thousand candidates, none of which is
// looked at when the nearest adds less than a ten-thousandth. Deterministic. A direction of no length, or
// numbers that are not finite: both ends at `low`, rounded to nearest.
GridAxis grid_axis(const AxisToRound& axis, int bits);

}  // namespace copse
