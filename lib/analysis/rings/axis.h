// axis: small geometry of limb axes: lines, segments, where several of them meet.
#pragma once

#include "lib/formats/vec.h"

#include <span>

namespace copse {

// A line by a point and a unit direction (zero: a point only), and how much it counts.
struct AxisLine {
  Double3 point, direction;
  double weight = 1;
};

// The point nearest to all lines in the least-squares sense, drawn slightly to the mean of their points, so
// that it exists for parallel lines too; that mean itself when the lines meet far outside them.
Double3 meeting_point(std::span<const AxisLine> lines);

// The share (0 to 1) of the way from a to b at which p is nearest to the segment; 0 when a is b.
double nearest_on_segment(const Double3& a, const Double3& b, const Double3& p);

}  // namespace copse
