#include "lib/analysis/volumes/principal_axes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

namespace copse {
namespace {

// A sum whose value does not depend on the order of its terms: each is split into a multiple of 2^-22 and one
// of 2^-49, and sums of either are exact for 2^26 terms up to 16.
class OrderFreeSum {
 public:
  void add(double term) {
    const double high = (term + k_high) - k_high;
    high_ += high;
    low_ += ((term - high) + k_low) - k_low;
  }
  double value() const { return high_ + low_; }

 private:
  static constexpr double k_high = 0x1.8p30;  // its last bit is 2^-22
  static constexpr double k_low = 0x1.8p3;    // 2^-49
  double high_ = 0, low_ = 0;
};

// Open addressing: the places of points whose like has not been met.
std::vector<Double3> each_once(std::span<const Double3> points) {
  const std::size_t size = std::bit_ceil(2 * points.size() + 2), mask = size - 1;
  std::vector<std::uint32_t> table(size, 0);  // 1 + place in `once`
  std::vector<Double3> once;
  once.reserve(points.size());
  for (const Double3& p : points) {
    std::uint64_t h = std::bit_cast<std::uint64_t>(p.x) * 0x9e3779b97f4a7c15u;
    h = (h ^ (h >> 29) ^ std::bit_cast<std::uint64_t>(p.y)) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 31) ^ std::bit_cast<std::uint64_t>(p.z)) * 0x94d049bb133111ebu;
    std::size_t slot = (h ^ (h >> 32)) & mask;
    while (table[slot] != 0 && once[table[slot] - 1] != p) slot = (slot + 1) & mask;
    if (table[slot] != 0) continue;
    once.push_back(p);
    table[slot] = static_cast<std::uint32_t>(once.size());
  }
  return once;
}

void rotate(std::array<std::array<double, 3>, 3>& a, Axes& v, int p, int q) {
  if (a[p][q] == 0) return;
  const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(theta, 1.0));
  const double c = 1 / std::hypot(t, 1.0), s = t * c;
  const double change = t * a[p][q];
  a[p][p] -= change, a[q][q] += change;
  a[p][q] = a[q][p] = 0;
  const int r = 3 - p - q;
  const double rp = a[r][p], rq = a[r][q];
  a[r][p] = a[p][r] = c * rp - s * rq;
  a[r][q] = a[q][r] = s * rp + c * rq;
  const Double3 vp = v[p], vq = v[q];
  v[p] = vp * c - vq * s;
  v[q] = vp * s + vq * c;
}

PrincipalAxes from_covariance(const Double3& mean, const std::array<double, 6>& covariance) {
  const Eigen3 e = eigen_of(covariance);
  PrincipalAxes found{mean, e.axes, {}};
  for (int i = 0; i < 3; ++i) found.variances[i] = std::max(0.0, e.values[i]);
  return found;
}

void add_outer(std::array<double, 6>& m, const Double3& d, double weight) {
  m[0] += weight * d.x * d.x, m[1] += weight * d.x * d.y, m[2] += weight * d.x * d.z;
  m[3] += weight * d.y * d.y, m[4] += weight * d.y * d.z, m[5] += weight * d.z * d.z;
}

}  // namespace

Eigen3 eigen_of(const std::array<double, 6>& m) {
  std::array<std::array<double, 3>, 3> a{{{m[0], m[1], m[2]}, {m[1], m[3], m[4]}, {m[2], m[4], m[5]}}};
  Axes v = k_world_axes;
  for (int sweep = 0; sweep < 12; ++sweep) {  // converges quadratically: 6 or 7 do
    if (a[0][1] == 0 && a[0][2] == 0 && a[1][2] == 0) break;
    rotate(a, v, 0, 1), rotate(a, v, 0, 2), rotate(a, v, 1, 2);
  }
  std::array<int, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return a[i][i] > a[j][j]; });
  Eigen3 found;
  for (int i = 0; i < 3; ++i) found.values[i] = a[order[i]][order[i]];
  found.axes = axes_along(v[order[0]], v[order[1]]);
  return found;
}

PrincipalAxes principal_axes(std::span<const Double3> points) {
  const std::vector<Double3> once = each_once(points);
  if (once.empty()) return {};
  const double n = static_cast<double>(once.size());
  std::array<OrderFreeSum, 3> sum;
  for (const Double3& p : once) sum[0].add(p.x), sum[1].add(p.y), sum[2].add(p.z);
  const Double3 mean{sum[0].value() / n, sum[1].value() / n, sum[2].value() / n};
  std::array<OrderFreeSum, 6> products;
  for (const Double3& p : once) {
    const Double3 d = p - mean;
    products[0].add(d.x * d.x), products[1].add(d.x * d.y), products[2].add(d.x * d.z);
    products[3].add(d.y * d.y), products[4].add(d.y * d.z), products[5].add(d.z * d.z);
  }
  std::array<double, 6> covariance;
  for (int i = 0; i < 6; ++i) covariance[i] = products[i].value() / n;
  return from_covariance(mean, covariance);
}

PrincipalAxes principal_axes(std::span<const Double3> points,
                             std::span<const std::array<std::uint32_t, 3>> triangles) {
  OrderFreeSum area_sum;
  std::array<OrderFreeSum, 3> first;  // moment
  const auto twice_area = [&](const std::array<std::uint32_t, 3>& t) {
    return length(cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]));
  };
  for (const auto& t : triangles) {
    const double a = twice_area(t);
    area_sum.add(a);
    const Double3 moment = (points[t[0]] + points[t[1]] + points[t[2]]) * (a / 3);
    for (int i = 0; i < 3; ++i) first[i].add(moment[i]);
  }
  const double area = area_sum.value();
  if (!(area > 0)) return principal_axes(points);
  const Double3 mean = Double3{first[0].value(), first[1].value(), first[2].value()} / area;
  std::array<OrderFreeSum, 6> sums;
  for (const auto& t : triangles) {
    const double weight = twice_area(t) / area / 12;
    const Double3 d0 = points[t[0]] - mean, d1 = points[t[1]] - mean, d2 = points[t[2]] - mean;
    std::array<double, 6> own{};
    add_outer(own, d0 + d1 + d2, weight);
    add_outer(own, d0, weight), add_outer(own, d1, weight), add_outer(own, d2, weight);
    for (int i = 0; i < 6; ++i) sums[i].add(own[i]);
  }
  std::array<double, 6> covariance;
  for (int i = 0; i < 6; ++i) covariance[i] = sums[i].value();
  return from_covariance(mean, covariance);
}

}  // namespace copse
