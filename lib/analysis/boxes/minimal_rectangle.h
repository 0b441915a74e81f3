// minimal_rectangle: the rectangle of least area round points of a plane.
//
// Source: H. Freeman, R. Shapira (1975): one side lies on an edge of the hull; G. Toussaint (1983): rotating
// calipers.
#pragma once

#include "lib/formats/vec.h"

#include <span>
#include <vector>

namespace copse {

using Double2 = Vec2<double>;

// The corners of the hull, counter-clockwise, first the lowest x (then y). Nearly collinear ones are dropped
// by the rounding of a double determinant. Fewer than 3 when the points are on a line. O(n log n).
std::vector<Double2> hull_of_plane(std::span<const Double2> points);

struct Rectangle {
  Double2 along{1, 0};  // unit; the first side's direction
  double area = 0;
};

// For the corners of a hull as above. O(n).
Rectangle minimal_rectangle(std::span<const Double2> hull);

}  // namespace copse
