#include "lib/analysis/hull/principal_axes.h"

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

// Moments of points up to the second, order-free at two operations a term: adding k_shift leaves a term, at
// most 4, as a multiple of 2^-49 in the last bits of the double, and integers are added without rounding.
class OrderFreeMoments {
 public:
  void add(const Double3& p) {
    x_[filled_] = p.x, y_[filled_] = p.y, z_[filled_] = p.z;
    if (++filled_ == k_block) flush();
  }
  std::array<double, 9> values() {  // x, y, z, xx, xy, xz, yy, yz, zz
    flush();
    std::array<double, 9> out;
    for (int k = 0; k < 9; ++k) {
      const auto high = static_cast<double>(high_[k] + (low_[k] >> 32));
      out[k] = high * 0x1p-17 + static_cast<double>(low_[k] & 0xffffffff) * 0x1p-49;
    }
    return out;
  }

 private:
  static constexpr double k_shift = 0x1.8p3;
  static constexpr std::size_t k_block = 512;  // whose sums, up to 2^60, an integer holds

  static std::uint64_t bits(double term) { return std::bit_cast<std::uint64_t>(term + k_shift); }

  void flush() {
    std::array<std::uint64_t, 9> sum{};
    for (std::size_t i = 0; i < filled_; ++i) {
      const double x = x_[i], y = y_[i], z = z_[i];
      sum[0] += bits(x), sum[1] += bits(y), sum[2] += bits(z);
      sum[3] += bits(x * x), sum[4] += bits(x * y), sum[5] += bits(x * z);
      sum[6] += bits(y * y), sum[7] += bits(y * z), sum[8] += bits(z * z);
    }
    for (int k = 0; k < 9; ++k) {
      const auto s = static_cast<std::int64_t>(sum[k] - filled_ * bits(0));
      high_[k] += s >> 32, low_[k] += s & 0xffffffff;
    }
    filled_ = 0;
  }

  std::array<double, k_block> x_, y_, z_;
  std::size_t filled_ = 0;
  std::array<std::int64_t, 9> high_{}, low_{};  // high 2^32 + low
};

std::uint64_t hash_of(const Double3& p) {
  std::uint64_t h = std::bit_cast<std::uint64_t>(p.x) * 0x9e3779b97f4a7c15u +
                    std::bit_cast<std::uint64_t>(p.y) * 0xbf58476d1ce4e5b9u +
                    std::bit_cast<std::uint64_t>(p.z) * 0x94d049bb133111ebu;
  return (h ^ (h >> 32)) * 0xd6e8feb86659fd93u;
}

// Takes every point whose like has not been met (open addressing) and tells how many those are.
template <class Take>
std::size_t each_once(std::span<const Double3> points, Take&& take) {
  const std::size_t size = std::bit_ceil(3 * points.size() + 2), mask = size - 1;
  const int shift = 64 - std::countr_zero(size);
  std::vector<std::uint32_t> table(size, 0);  // 1 + index of the point
  std::size_t distinct = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Double3& p = points[i];
    std::size_t slot = hash_of(p) >> shift;
    while (table[slot] != 0 && points[table[slot] - 1] != p) slot = (slot + 1) & mask;
    if (table[slot] != 0) continue;
    table[slot] = static_cast<std::uint32_t>(i + 1);
    ++distinct;
    take(p);
  }
  return distinct;
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
  OrderFreeMoments moments;
  const std::size_t distinct = each_once(points, [&](const Double3& p) { moments.add(p); });
  if (distinct == 0) return {};
  std::array<double, 9> m = moments.values();
  for (double& v : m) v /= static_cast<double>(distinct);
  return from_covariance({m[0], m[1], m[2]}, {m[3] - m[0] * m[0], m[4] - m[0] * m[1], m[5] - m[0] * m[2],
                                              m[6] - m[1] * m[1], m[7] - m[1] * m[2], m[8] - m[2] * m[2]});
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
