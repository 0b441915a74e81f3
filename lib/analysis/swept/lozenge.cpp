#include "lib/analysis/swept/lozenge.h"

#include "lib/analysis/hull/point_cloud.h"
#include "lib/analysis/hull/principal_axes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace copse {
namespace {

// [low, high] so that every q is within its half width of it, as near to one another as may be.
struct Side {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  void add(double q, double half) { low = std::min(low, q + half), high = std::max(high, q - half); }
  bool holds(double q) const { return q >= low && q <= high; }  // whatever its half width
  void close() {
    if (high < low) low = high = (low + high) / 2;
  }
};

class FromRectangle {
 public:
  explicit FromRectangle(const Lozenge<double>& l)
      : origin_(l.origin), edges_{l.edge0, l.edge1}, squares_{dot(l.edge0, l.edge0), dot(l.edge1, l.edge1)} {}
  double squared(const Double3& p) const {
    const Double3 q = p - origin_;
    const auto along = [&](int i) {
      return squares_[i] > 0 ? std::clamp(dot(q, edges_[i]) / squares_[i], 0.0, 1.0) : 0;
    };
    const Double3 rest = q - edges_[0] * along(0) - edges_[1] * along(1);
    return dot(rest, rest);
  }

 private:
  Double3 origin_;
  std::array<Double3, 2> edges_;
  std::array<double, 2> squares_;
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

// The thinnest slab across the third axis, and sides as short as its points allow; `local`: the points in the
// frame.
SweptRectangle rectangle_of_sides(std::span<const Double3> points, const Axes& frame,
                                  std::vector<Double3>& local) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < points.size(); ++i) {
    local[i] = into(frame, points[i]);
    low = std::min(low, local[i].z), high = std::max(high, local[i].z);
  }
  SweptRectangle s;
  s.h = (low + high) / 2, s.r = (high - low) / 2;
  Side a, b;
  for (const Double3& q : local) {
    if (a.holds(q.x) && b.holds(q.y)) continue;
    const double half = std::sqrt(std::max(0.0, s.r * s.r - (q.z - s.h) * (q.z - s.h)));
    a.add(q.x, half), b.add(q.y, half);
  }
  a.close(), b.close();
  s.a0 = a.low, s.a1 = a.high, s.b0 = b.low, s.b1 = b.high;
  return s;
}

double farthest_square(std::span<const Double3> local, const SweptRectangle& s) {
  double square = 0;
  for (const Double3& q : local) {
    const Double3 e = offset_from(s, q);
    square = std::max(square, dot(e, e));
  }
  return square;
}

}  // namespace

double interior_volume(const Lozenge<double>& l) {
  return swept_volume({length(l.edge0), length(l.edge1), l.radius});
}

double distance_from_rectangle(const Lozenge<double>& l, const Double3& p) {
  return std::sqrt(FromRectangle(l).squared(p));
}

Lozenge<double> enclosing(Lozenge<double> l, std::span<const Double3> points) {
  const FromRectangle from(l);
  double square = 0;
  for (const Double3& p : points) square = std::max(square, from.squared(p));
  l.radius = std::sqrt(square);
  return l;
}

Lozenge<double> placed(const SweptRectangle& s, const Axes& frame) {
  return {out_of(frame, {s.a0, s.b0, s.h}), frame[0] * (s.a1 - s.a0), frame[1] * (s.b1 - s.b0), s.r};
}

Lozenge<double> lozenge_in_frame(std::span<const Double3> points, const Axes& frame) {
  std::vector<Double3> local(points.size());
  SweptRectangle s = rectangle_of_sides(points, frame, local);
  // What a corner leaves out moves it, in an order that is not that of the points: no other becomes one of
  // them.
  std::vector<Double3> beyond;
  double square = 0;
  for (const Double3& q : local) {
    const Double3 e = offset_from(s, q);
    const double d = dot(e, e);
    square = std::max(square, d);
    if (e.x != 0 && e.y != 0 && d > s.r * s.r) beyond.push_back(q);
  }
  for (const Double3& q : distinct_points(beyond)) move_corner(q, s);
  if (!beyond.empty()) square = farthest_square(local, s);
  // The radius is that of the inequality: of the points that may have the largest, but for rounding.
  const double reach =
      std::max({std::abs(s.a0), std::abs(s.a1), std::abs(s.b0), std::abs(s.b1), std::abs(s.h)});
  const double least = std::max(0.0, std::sqrt(square) - (reach + std::sqrt(square)) * 0x1p-40);
  std::vector<Double3> outermost;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Double3 e = offset_from(s, local[i]);
    if (dot(e, e) >= least * least) outermost.push_back(points[i]);
  }
  return enclosing(placed(s, frame), outermost);
}

Lozenge<double> gaussian_lozenge(std::span<const Double3> points) {
  if (points.empty()) return {};
  return lozenge_in_frame(points, principal_axes(points).axes);
}

}  // namespace copse
