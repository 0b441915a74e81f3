#include "lib/analysis/volumes/volume_measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace copse {
namespace {

constexpr double k_pi = std::numbers::pi;

// A rectangle of sides a and b with a ball of radius r swept over it.
VolumeMeasures of_lozenge(double a, double b, double r) {
  return {2 * r * a * b + k_pi * r * r * (a + b) + 4 * k_pi / 3 * r * r * r,
          2 * a * b + 2 * k_pi * r * (a + b) + 4 * k_pi * r * r, (a + b) / 2 + 2 * r};
}

VolumeMeasures of_box(double a, double b, double c) {
  return {a * b * c, 2 * (a * b + b * c + c * a), (a + b + c) / 2};
}

// Carlson's R_F and R_D by duplication; x, y >= 0, not both 0, z > 0. Arguments of very different size take
// more steps, 4 a factor of 256.
struct Carlson {
  double f, d;
};
Carlson carlson(double x, double y, double z) {
  double sum = 0, weight = 1;
  const auto spread = [&](double mean) {
    return std::max({std::abs(mean - x), std::abs(mean - y), std::abs(mean - z)}) / mean;
  };
  double mean_f = (x + y + z) / 3, mean_d = (x + y + 3 * z) / 5;
  while (spread(mean_f) > 1e-3 || spread(mean_d) > 1e-3) {  // the series lose the sixth power of it
    const double lambda = std::sqrt(x * y) + std::sqrt(x * z) + std::sqrt(y * z);
    sum += weight / (std::sqrt(z) * (z + lambda));
    weight /= 4;
    x = (x + lambda) / 4, y = (y + lambda) / 4, z = (z + lambda) / 4;
    mean_f = (x + y + z) / 3, mean_d = (x + y + 3 * z) / 5;
  }
  const double fx = 1 - x / mean_f, fy = 1 - y / mean_f, fz = -fx - fy;
  const double e2 = fx * fy - fz * fz, e3 = fx * fy * fz;
  const double f = (1 - e2 / 10 + e3 / 14 + e2 * e2 / 24) / std::sqrt(mean_f);
  const double dx = 1 - x / mean_d, dy = 1 - y / mean_d, dz = -(dx + dy) / 3;
  const double g2 = dx * dy - 6 * dz * dz, g3 = (3 * dx * dy - 8 * dz * dz) * dz;
  const double series = 1 - 3 * g2 / 14 + g3 / 6 + 9 * g2 * g2 / 88;
  return {f, weight * series / (mean_d * std::sqrt(mean_d)) + 3 * sum};
}

// The mean of |(a u, b v, c w)| over unit (u, v, w): R_G(a^2, b^2, c^2).
double mean_radius(double a, double b, double c) {
  std::array<double, 3> s{a, b, c};
  std::sort(s.begin(), s.end());
  if (s[2] == 0) return 0;
  if (s[1] == 0) return s[2] / 2;  // a segment
  const double unit = s[2];
  const double x = (s[0] / unit) * (s[0] / unit), z = (s[1] / unit) * (s[1] / unit), y = 1;
  const Carlson k = carlson(x, y, z);  // z in the middle: (x - z)(y - z) <= 0, so nothing cancels
  return unit * (z * k.f - (x - z) * (y - z) * k.d / 3 + std::sqrt(x * y / z)) / 2;
}

}  // namespace

VolumeMeasures measures_of(const Box<double>& v) {
  const Double3 e = v.extent();
  return of_box(e.x, e.y, e.z);
}
VolumeMeasures measures_of(const BoundingSphere<double>& v) {
  return of_lozenge(0, 0, v.radius);
}
VolumeMeasures measures_of(const OrientedBox<double>& v) {
  return of_box(2 * v.half_extents.x, 2 * v.half_extents.y, 2 * v.half_extents.z);
}
VolumeMeasures measures_of(const Capsule<double>& v) {
  return of_lozenge(distance(v.a, v.b), 0, v.radius);
}
VolumeMeasures measures_of(const Cylinder<double>& v) {
  const double h = distance(v.a, v.b), r = v.radius;
  return {k_pi * r * r * h, 2 * k_pi * r * (r + h), (h + k_pi * r) / 2};
}
VolumeMeasures measures_of(const Lozenge<double>& v) {
  return of_lozenge(length(v.edge0), length(v.edge1), v.radius);
}
VolumeMeasures measures_of(const Ellipsoid<double>& v) {
  const double a = v.semi_axes.x, b = v.semi_axes.y, c = v.semi_axes.z;
  return {4 * k_pi / 3 * a * b * c, 4 * k_pi * mean_radius(a * b, b * c, c * a), 2 * mean_radius(a, b, c)};
}
VolumeMeasures measures_of(const Volume<double>& v) {
  return std::visit([](const auto& one) { return measures_of(one); }, v);
}

}  // namespace copse
