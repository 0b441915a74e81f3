// How far stored float32 numbers may be from what is recomputed of them. The writer computed in double from
// double positions; a reader has the positions rounded to float32. So everything is relative to the largest
// coordinate, in units of float32's rounding.
#pragma once

#include "lib/formats/vec.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace copse {

inline constexpr double k_float_rounding = 0x1p-24;   // of the nearest float32, relative
inline constexpr double k_double_rounding = 0x1p-53;  // of the nearest double, relative

inline double largest_coordinate(const FloatBox& box) {
  if (box.empty()) return 0;
  double largest = 0;
  for (int i = 0; i < 3; ++i) {
    largest = std::max({largest, std::abs(double{box.min[i]}), std::abs(double{box.max[i]})});
  }
  return largest;
}

// A length between two points whose coordinates reach `reach`: each end moves by at most sqrt(3) roundings of
// the largest coordinate, and centres that are chained with error feedback by twice that.
inline double length_tolerance(double length, double reach) {
  return 8 * k_float_rounding * (reach + length) + std::numeric_limits<float>::denorm_min();
}

// An area and how much larger or smaller rounding of its corners (or what is unknown) may make it.
struct Area {
  double value = 0;
  double less = 0, more = 0;
  Area& operator+=(const Area& b) { return value += b.value, less += b.less, more += b.more, *this; }
  friend Area operator*(double s, const Area& a) { return {s * a.value, s * a.less, s * a.more}; }
};

// Of float32 corners: no product of their differences leaves the range of double, so that plain square roots
// are safe and, unlike hypot, fast.
inline Area triangle_area(const Double3& a, const Double3& b, const Double3& c, double reach) {
  const Double3 u = b - a, v = c - a, w = cross(u, v);
  const double moved = 4 * k_float_rounding * reach;  // of a difference of two corners
  const auto bound = [](const Double3& d) { return std::abs(d.x) + std::abs(d.y) + std::abs(d.z); };
  const double slack = moved * (2 * (bound(u) + bound(v)) + moved);  // of the perimeter
  return {0.5 * std::sqrt(dot(w, w)), slack, slack};
}

// The nearest float32, but finite: what a writer stores of a sum that float32 cannot hold.
inline double as_stored(double value) {
  return std::min(value, double{std::numeric_limits<float>::max()});
}

// Whether a stored mean may be the rounding of `expected`.
inline bool mean_matches(float stored, const Area& expected) {
  const double slack = 1e-6 * expected.value + std::numeric_limits<float>::denorm_min();
  const double value = stored;
  return value >= as_stored(expected.value - expected.less - slack) &&
         value <= as_stored(expected.value + expected.more + slack);
}

}  // namespace copse
