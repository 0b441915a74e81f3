// triangle_distance: from a point to the nearest point of a triangle.
#pragma once

#include "lib/formats/vec.h"

#include <algorithm>

namespace copse {

// Squared (Ericson, "Real-Time Collision Detection", section 5.1.5). Of triangles of no size, too.
inline double square_distance(const Double3& p, const Double3& a, const Double3& b, const Double3& c) {
  const Double3 ab = b - a, ac = c - a, ap = p - a;
  const auto to = [&](const Double3& q) { return dot(p - q, p - q); };
  const auto along = [&](double part, double whole) { return whole > 0 ? part / whole : 0; };
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return to(a);
  const Double3 bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return to(b);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return to(a + ab * along(d1, d1 - d3));
  const Double3 cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return to(c);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return to(a + ac * along(d2, d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return to(b + (c - b) * along(d4 - d3, (d4 - d3) + (d5 - d6)));
  const double sum = va + vb + vc;
  return sum > 0 ? to(a + ab * (vb / sum) + ac * (vc / sum)) : std::min({to(a), to(b), to(c)});
}

// Squared, to a box; infinite to an empty one.
template <class T>
double square_distance(const Double3& p, const Box<T>& box) {
  if (box.empty()) return std::numeric_limits<double>::infinity();
  double sum = 0;
  for (int a = 0; a < 3; ++a) {
    const double d = std::max({double(box.min[a]) - p[a], 0.0, p[a] - double(box.max[a])});
    sum += d * d;
  }
  return sum;
}

}  // namespace copse
