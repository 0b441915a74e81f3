#include "lib/analysis/round/smallest_circle.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace copse {
namespace {

using Double2 = Vec2<double>;

constexpr double k_inside = 1 + 2e-15;  // of the radius: no farther is on the circle
constexpr double k_grown = 1 + 1e-13;
constexpr int k_idle_steps = 16;  // that neither grow the circle nor find a nearer centre: rounding rules

double squared_distance(const Double2& a, const Double2& b) {
  const double x = a.x - b.x, y = a.y - b.y;
  return x * x + y * y;
}

class SupportCircle {
 public:
  explicit SupportCircle(std::span<const Double2> points) : points_(points) {}

  const Double2& centre() const { return centre_; }
  double radius() const { return radius_; }
  const std::array<std::uint32_t, 3>& support() const { return support_; }
  int size() const { return size_; }

  // The smallest circle of the support and this point.
  void include(std::uint32_t point) {
    if (size_ == 0) return start(point);
    const std::array<std::uint32_t, 3> old = support_;
    const int count = size_;
    double best = std::numeric_limits<double>::infinity();
    const auto consider = [&](const Double2& c, std::array<std::uint32_t, 3> support, int size) {
      double most = squared_distance(c, points_[point]);
      for (int i = 0; i < count; ++i) most = std::max(most, squared_distance(c, points_[old[i]]));
      if (!(most < best)) return;
      best = most, centre_ = c, support_ = support, size_ = size;
    };
    for (int i = 0; i < count; ++i) {
      const Double2 &p = points_[point], &q = points_[old[i]];
      consider({(p.x + q.x) / 2, (p.y + q.y) / 2}, {point, old[i], 0}, 2);
      for (int j = i + 1; j < count; ++j)
        consider(circumcentre(p, q, points_[old[j]]), {point, old[i], old[j]}, 3);
    }
    radius_ = std::sqrt(best);
  }

 private:
  void start(std::uint32_t point) {
    support_ = {point, 0, 0}, size_ = 1;
    centre_ = points_[point];
  }
  static Double2 circumcentre(const Double2& p, const Double2& q, const Double2& r) {
    const Double2 a{q.x - p.x, q.y - p.y}, b{r.x - p.x, r.y - p.y};
    const double aa = a.x * a.x + a.y * a.y, bb = b.x * b.x + b.y * b.y;
    const double d = 2 * (a.x * b.y - a.y * b.x);
    return {p.x + (b.y * aa - a.y * bb) / d, p.y + (a.x * bb - b.x * aa) / d};
  }

  std::span<const Double2> points_;
  Double2 centre_;
  double radius_ = 0;
  std::array<std::uint32_t, 3> support_{};
  int size_ = 0;
};

bool comes_before(const Double2& a, const Double2& b) {
  return a.x != b.x ? a.x < b.x : a.y < b.y;
}

// Of equally far ones that of the least coordinates, in whatever order they come.
std::uint32_t farthest_from(const Double2& centre, std::span<const Double2> points, double& squared) {
  std::uint32_t far = 0;
  squared = -1;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const double d = squared_distance(centre, points[i]);
    if (d > squared || (d == squared && comes_before(points[i], points[far]))) squared = d, far = i;
  }
  return far;
}

}  // namespace

SmallestCircle smallest_circle(std::span<const Double2> points, std::span<const std::uint32_t> likely) {
  SmallestCircle best;
  if (points.empty()) return best;
  SupportCircle circle(points);
  double squared = 0, grown = 0;
  for (const std::uint32_t i : likely) {
    // What is inside does not hold it.
    const double radius = circle.radius();
    if (circle.size() == 0 || squared_distance(circle.centre(), points[i]) > radius * radius)
      circle.include(i);
  }
  if (likely.empty())
    circle.include(farthest_from(*std::ranges::min_element(points, comes_before), points, squared));
  best.radius = std::numeric_limits<double>::infinity();
  for (int idle = 0;;) {
    const std::uint32_t far = farthest_from(circle.centre(), points, squared);
    const double reach = std::sqrt(squared);
    const bool nearer = reach<best.radius, larger = circle.radius()> grown * k_grown;
    if (nearer) best.centre = circle.centre(), best.radius = reach;
    // What bounds from below may come a step after what reaches all, in symmetric sets.
    if (best.supports == 0 || circle.radius() > best.lower_radius)
      best.lower_radius = circle.radius(), best.support = circle.support(), best.supports = circle.size();
    grown = std::max(grown, circle.radius());
    idle = nearer || larger ? 0 : idle + 1;
    if (reach <= circle.radius() * k_inside || idle == k_idle_steps) return best;
    circle.include(far);
  }
}

}  // namespace copse
