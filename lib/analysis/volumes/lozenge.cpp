#include "lib/analysis/volumes/lozenge.h"

#include "lib/analysis/volumes/principal_axes.h"

#include <algorithm>
#include <limits>

namespace copse {
namespace {

// [low, high] so that every q is within its half width of it, as near to one another as may be.
struct Side {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  void add(double q, double half) { low = std::min(low, q + half), high = std::max(high, q - half); }
  void close() {
    if (high < low) low = high = (low + high) / 2;
  }
};

// Moves the corner towards a point beyond both of its sides until the quarter ball reaches it.
void move_corner(const Double3& q, SweptRectangle& s) {
  const Double3 e = offset_from(s, q);
  if (e.x == 0 || e.y == 0) return;
  const double square = std::max(0.0, s.r * s.r - e.z * e.z), outside = e.x * e.x + e.y * e.y;
  if (outside <= square) return;
  const double t = std::sqrt(square / outside);
  (e.x < 0 ? s.a0 : s.a1) = q.x - e.x * t;
  (e.y < 0 ? s.b0 : s.b1) = q.y - e.y * t;
}

}  // namespace

double interior_volume(const Lozenge<double>& l) {
  return swept_volume({length(l.edge0), length(l.edge1), l.radius});
}

double distance_from_rectangle(const Lozenge<double>& l, const Double3& p) {
  const Double3 q = p - l.origin;
  const auto along = [&](const Double3& edge) {
    const double square = dot(edge, edge);
    return square > 0 ? std::clamp(dot(q, edge) / square, 0.0, 1.0) : 0;
  };
  return length(q - l.edge0 * along(l.edge0) - l.edge1 * along(l.edge1));
}

Lozenge<double> enclosing(Lozenge<double> l, std::span<const Double3> points) {
  l.radius = 0;
  for (const Double3& p : points) l.radius = std::max(l.radius, distance_from_rectangle(l, p));
  return l;
}

Lozenge<double> placed(const SweptRectangle& s, const Axes& frame) {
  return {out_of(frame, {s.a0, s.b0, s.h}), frame[0] * (s.a1 - s.a0), frame[1] * (s.b1 - s.b0), s.r};
}

Lozenge<double> lozenge_in_frame(std::span<const Double3> points, const Axes& frame) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Double3& p : points) {
    const double w = dot(frame[2], p);
    low = std::min(low, w), high = std::max(high, w);
  }
  SweptRectangle s;
  s.h = (low + high) / 2, s.r = (high - low) / 2;
  Side a, b;
  for (const Double3& p : points) {
    const Double3 q = into(frame, p);
    const double half = std::sqrt(std::max(0.0, s.r * s.r - (q.z - s.h) * (q.z - s.h)));
    a.add(q.x, half), b.add(q.y, half);
  }
  a.close(), b.close();
  s.a0 = a.low, s.a1 = a.high, s.b0 = b.low, s.b1 = b.high;
  for (const Double3& p : points) move_corner(into(frame, p), s);
  return enclosing(placed(s, frame), points);
}

Lozenge<double> gaussian_lozenge(std::span<const Double3> points) {
  if (points.empty()) return {};
  return lozenge_in_frame(points, principal_axes(points).axes);
}

}  // namespace copse
