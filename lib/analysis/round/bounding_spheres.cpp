#include "lib/analysis/round/bounding_spheres.h"

#include "lib/analysis/hull/principal_axes.h"
#include "lib/analysis/round/minimal_sphere.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace copse {
namespace {

// Relative: the support's ball, and the distances, are known to this.
constexpr double k_rounding = 1e-13;

struct Far {
  Double3 point;
  double squared = -1;
};

Far farthest_from(const Double3& centre, const std::vector<Double3>& points) {
  Far far;
  for (const Double3& p : points) {
    const Double3 d = p - centre;
    const double squared = dot(d, d);
    if (squared > far.squared || (squared == far.squared && lexicographically_less(p, far.point)))
      far = {p, squared};
  }
  return far;
}

BoundingSphere<double> sphere_about(const Double3& centre, const std::vector<Double3>& points) {
  return {centre, std::sqrt(farthest_from(centre, points).squared)};
}

std::vector<Double3> extreme_points(const std::vector<Double3>& points) {
  constexpr std::array<Double3, 7> k_directions{
      {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {1, -1, -1}}};
  std::array<double, 7> low, high;
  std::array<Double3, 7> first, last;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (const Double3& p : points) {
    for (std::size_t i = 0; i < k_directions.size(); ++i) {
      const double d = dot(k_directions[i], p);
      if (d < low[i] || (d == low[i] && lexicographically_less(p, first[i]))) low[i] = d, first[i] = p;
      if (d > high[i] || (d == high[i] && lexicographically_less(p, last[i]))) high[i] = d, last[i] = p;
    }
  }
  std::vector<Double3> extreme(first.begin(), first.end());
  extreme.insert(extreme.end(), last.begin(), last.end());
  return extreme;
}

}  // namespace

BoundingSphere<double> box_sphere(const PointCloud& cloud) {
  return sphere_about(cloud.box.centre(), cloud.points);
}

BoundingSphere<double> mean_sphere(const PointCloud& cloud) {
  return sphere_about(principal_axes(cloud.points).mean, cloud.points);
}

BoundingSphere<double> extremal_sphere(const PointCloud& cloud) {
  BoundingSphere<double> ball = minimal_sphere(extreme_points(cloud.points));
  for (int round = 0; round < 2; ++round) {
    const Far far = farthest_from(ball.centre, cloud.points);
    const double reach = std::sqrt(far.squared);
    if (reach <= ball.radius) break;
    // The smallest ball of the ball and the point.
    ball.centre += (far.point - ball.centre) * ((reach - ball.radius) / (2 * reach));
    ball.radius = (reach + ball.radius) / 2;
  }
  return sphere_about(ball.centre, cloud.points);
}

SupportedSphere smallest_sphere(const PointCloud& cloud) {
  const MinimalSphere found = minimal_sphere_and_support(cloud.points, cloud.box);
  const double r = found.lower_radius * (1 - k_rounding);
  return {{found.sphere, 4 * std::numbers::pi / 3 * r * r * r}, found.support};
}

}  // namespace copse
