#include "lib/analysis/lod/patch.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace copse {
namespace {

constexpr int k_jacobi_sweeps = 12;  // converges quadratically; 4 to 6 are enough in double

// One Jacobi rotation that makes a[p][q] zero.
void rotate(std::array<std::array<double, 3>, 3>& a, std::array<std::array<double, 3>, 3>& v, int p, int q) {
  if (a[p][q] == 0) return;
  const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  const double t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
  const double c = 1 / std::sqrt(t * t + 1), s = t * c;
  for (int k = 0; k < 3; ++k) {
    const double kp = a[k][p], kq = a[k][q];
    a[k][p] = c * kp - s * kq, a[k][q] = s * kp + c * kq;
  }
  for (int k = 0; k < 3; ++k) {
    const double pk = a[p][k], qk = a[q][k];
    a[p][k] = c * pk - s * qk, a[q][k] = s * pk + c * qk;
  }
  for (int k = 0; k < 3; ++k) {
    const double kp = v[k][p], kq = v[k][q];
    v[k][p] = c * kp - s * kq, v[k][q] = s * kp + c * kq;
  }
}

// The largest component is positive, the first one of equals.
Double3 with_sign(const Double3& v) {
  int k = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(v[i]) > std::abs(v[k])) k = i;
  return v[k] < 0 ? -v : v;
}

}  // namespace

void Symmetric3::add(const Double3& v, double w) {
  m[0] += w * v.x * v.x, m[1] += w * v.y * v.y, m[2] += w * v.z * v.z;
  m[3] += w * v.x * v.y, m[4] += w * v.x * v.z, m[5] += w * v.y * v.z;
}

double Symmetric3::along(const Double3& v) const {
  return m[0] * v.x * v.x + m[1] * v.y * v.y + m[2] * v.z * v.z +
         2 * (m[3] * v.x * v.y + m[4] * v.x * v.z + m[5] * v.y * v.z);
}

Eigen3 eigen(const Symmetric3& s) {
  const auto& m = s.m;
  std::array<std::array<double, 3>, 3> a{{{m[0], m[3], m[4]}, {m[3], m[1], m[5]}, {m[4], m[5], m[2]}}};
  std::array<std::array<double, 3>, 3> v{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (int sweep = 0; sweep < k_jacobi_sweeps; ++sweep) {
    if (a[0][1] * a[0][1] + a[0][2] * a[0][2] + a[1][2] * a[1][2] <= 1e-30 * s.trace() * s.trace()) break;
    rotate(a, v, 0, 1), rotate(a, v, 0, 2), rotate(a, v, 1, 2);
  }
  std::array<int, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return a[i][i] > a[j][j]; });
  Eigen3 out;
  for (int i = 0; i < 3; ++i) {
    const int k = order[i];
    out.values[i] = a[k][k];
    out.vectors[i] = with_sign({v[0][k], v[1][k], v[2][k]});
  }
  out.vectors[2] = cross(out.vectors[0], out.vectors[1]);
  return out;
}

Patch& Patch::operator+=(const Patch& b) {
  area += b.area, opaque += b.opaque, visible += b.visible, open += b.open;
  first += b.first, second += b.second, facing += b.facing, shading += b.shading, up += b.up;
  return *this;
}

Symmetric3 Patch::covariance() const {
  Symmetric3 out;
  if (!(area > 0)) return out;
  const Double3 c = centre();
  out = second;
  for (double& x : out.m) x /= area;
  out.add(c, -1);
  for (int i = 0; i < 3; ++i) out.m[i] = std::max(out.m[i], 0.0);
  return out;
}

Patch patch_of(const std::array<Double3, 3>& t, double opacity, double exposure) {
  Patch p;
  const Double3 n = cross(t[1] - t[0], t[2] - t[0]);
  const double twice = std::sqrt(dot(n, n));
  p.area = 0.5 * twice, p.opaque = p.area * opacity, p.visible = p.opaque * exposure;
  if (!(p.area > 0)) return p;
  const Double3 sum = t[0] + t[1] + t[2];
  p.first = sum * (p.area / 3);
  // integral of x x^T over a triangle: A / 12 (9 c c^T + sum of corner corner^T)
  p.second.add(sum, p.area / 12);
  for (const Double3& c : t) p.second.add(c, p.area / 12);
  p.facing.add(n / twice, p.area);
  return p;
}

}  // namespace copse
