#include "lib/analysis/skeleton/section.h"

#include "lib/analysis/surface/welded_tolerances.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace copse {

Sections::Sections(const Surface& surface)
    : s_(surface),
      seen_(surface.triangles.size(), 0),
      steps_left_(k_section_steps + k_section_steps_of_triangle * surface.triangles.size()) {}

Double3 Sections::crossing(std::uint32_t a, std::uint32_t b) const {
  if (a > b) std::swap(a, b);  // the same point from both sides
  const Double3 &pa = s_.positions[a], &pb = s_.positions[b];
  const double da = dot(pa - point_, normal_), db = dot(pb - point_, normal_);
  return pa + (pb - pa) * (da / (da - db));
}

// Follows the outline out of `t` through its edge, adding the points where it crosses edges, to a border or
// to a triangle that was seen; returns the latter, or k_none.
std::uint32_t Sections::follow(std::uint32_t t, std::size_t edge, std::vector<Double3>& points) {
  for (;;) {
    const std::uint32_t a = s_.triangles[t][edge], b = s_.triangles[t][(edge + 1) % 3];
    points.push_back(crossing(a, b));
    const std::uint32_t n = s_.across[t][edge];
    if (n == k_none || seen_[n] == stamp_) return n;
    seen_[n] = stamp_;
    const Triangle& c = s_.triangles[n];
    const auto entry = static_cast<std::size_t>(edge_between(c, a, b));
    const std::size_t next = (entry + 1) % 3;
    edge = above(c[next]) != above(c[(next + 1) % 3]) ? next : (entry + 2) % 3;
    t = n;
  }
}

bool Sections::trace(std::uint32_t seed, Outline& outline) {
  outline.points.clear();
  const Triangle& c = s_.triangles[seed];
  const bool s[3] = {above(c[0]), above(c[1]), above(c[2])};
  if (s[0] == s[1] && s[1] == s[2]) return false;
  const std::size_t lone = s[0] == s[1] ? 2 : s[1] == s[2] ? 0 : 1;
  seen_[seed] = stamp_;
  std::vector<Double3>& points = outline.points;
  if (follow(seed, lone, points) != seed) {  // it is open: add what lies the other way
    std::vector<Double3> back;
    follow(seed, (lone + 2) % 3, back);
    points.insert(points.begin(), back.rbegin(), back.rend());
  }
  double turned = 0;
  outline.length = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Double3 p = points[i] - point_, q = points[(i + 1) % points.size()] - point_;
    outline.length += distance(p, q);
    turned += std::atan2(dot(cross(p, q), normal_), dot(p, q));
  }
  outline.around = std::abs(turned) > std::numbers::pi;
  return outline.length > 0;
}

RingCircle Sections::circle_of(const Outline& outline) const {
  // Corners, in the plane, relative to the point; repeated ones once.
  struct Corner {
    double x, y, weight;
  };
  std::vector<Corner> corners;
  const double tiny = outline.length * k_same_corner;
  for (const Double3& p : outline.points) {
    const Corner c{dot(p - point_, u_), dot(p - point_, v_), 0};
    if (corners.empty() || std::hypot(c.x - corners.back().x, c.y - corners.back().y) > tiny)
      corners.push_back(c);
  }
  while (corners.size() > 1 &&
         std::hypot(corners[0].x - corners.back().x, corners[0].y - corners.back().y) <= tiny) {
    corners.pop_back();
  }
  const std::size_t n = corners.size();
  double sum = 0, sum_abs = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Corner &a = corners[(i + n - 1) % n], &b = corners[i], &c = corners[(i + 1) % n];
    const double ux = b.x - a.x, uy = b.y - a.y, wx = c.x - b.x, wy = c.y - b.y;
    corners[i].weight = std::atan2(ux * wy - uy * wx, ux * wx + uy * wy);
    sum += corners[i].weight, sum_abs += std::abs(corners[i].weight);
  }
  if (n < 3 || std::abs(sum) < std::numbers::pi || sum_abs > k_nearly_convex * std::abs(sum)) {
    sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const Corner &a = corners[(i + n - 1) % n], &b = corners[i], &c = corners[(i + 1) % n];
      corners[i].weight = std::hypot(b.x - a.x, b.y - a.y) + std::hypot(c.x - b.x, c.y - b.y);
      sum += corners[i].weight;
    }
  }
  if (sum == 0) return {point_, 0};
  double x = 0, y = 0, radius = 0;
  for (const Corner& c : corners) x += c.x * c.weight / sum, y += c.y * c.weight / sum;
  for (const Corner& c : corners) radius += std::hypot(c.x - x, c.y - y) * c.weight / sum;
  return {point_ + u_ * x + v_ * y, std::max(radius, 0.0)};
}

void Sections::look_along(const Double3& point, const Double3& normal) {
  point_ = point, normal_ = normal;
  const Double3 any = std::abs(normal.x) < 0.5 ? Double3{1, 0, 0} : Double3{0, 1, 0};
  u_ = normalized(cross(any, normal)), v_ = cross(normal, u_);
}

RingCircle Sections::circle_round(std::span<const Double3> points, const Double3& normal) {
  Outline outline;
  outline.points.assign(points.begin(), points.end());
  Double3 mean;
  for (std::size_t i = 0; i < points.size(); ++i) {
    outline.length += distance(points[i], points[(i + 1) % points.size()]);
    mean += (points[i] - points[0]) / static_cast<double>(points.size());
  }
  look_along(points[0] + mean, normal);  // so that the circle lies at the points' mean height
  return circle_of(outline);
}

bool Sections::cut(const Double3& point, const Double3& normal, std::span<const std::uint32_t> seeds,
                   RingCircle& circle) {
  if (steps_left_ == 0) return false;
  look_along(point, normal);
  ++stamp_;
  Outline outline, best;
  std::size_t steps = seeds.size();
  for (const std::uint32_t t : seeds) {
    if (seen_[t] == stamp_) continue;
    const bool is_cut = trace(t, outline);
    steps += outline.points.size();
    if (!is_cut) continue;
    const bool better = best.points.empty() || (outline.around && !best.around) ||
                        (outline.around == best.around && outline.around
                             ? outline.length < best.length
                             : outline.around == best.around && outline.length > best.length);
    if (better) std::swap(best, outline);
  }
  steps_left_ -= std::min(steps, steps_left_);
  if (best.points.empty()) return false;
  circle = circle_of(best);
  return is_finite(circle.centre);
}

}  // namespace copse
