#include "lib/analysis/volumes/principal_frame.h"

#include <algorithm>
#include <numeric>

namespace copse {
namespace {

constexpr int k_sweeps = 16;  // Jacobi's method converges quadratically: some six do

// Turns axes p and q so that m[p][q] vanishes.
void rotate(std::array<Double3, 3>& m, Frame3& axes, int p, int q) {
  if (m[p][q] == 0) return;
  const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
  const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::hypot(theta, 1.0));
  const double c = 1 / std::hypot(t, 1.0), s = t * c;
  const int k = 3 - p - q;
  const double mpq = m[p][q], mkp = m[k][p], mkq = m[k][q];
  m[p][p] -= t * mpq, m[q][q] += t * mpq;
  m[p][q] = m[q][p] = 0;
  m[k][p] = m[p][k] = c * mkp - s * mkq;
  m[k][q] = m[q][k] = s * mkp + c * mkq;
  const Double3 u = axes[p], v = axes[q];
  axes[p] = u * c - v * s, axes[q] = u * s + v * c;
}

}  // namespace

void principal_axes(std::array<Double3, 3> m, Frame3& axes, Double3& values) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < i; ++j) m[i][j] = m[j][i];
  }
  axes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (int sweep = 0; sweep < k_sweeps && (m[0][1] != 0 || m[0][2] != 0 || m[1][2] != 0); ++sweep) {
    rotate(m, axes, 0, 1), rotate(m, axes, 0, 2), rotate(m, axes, 1, 2);
  }
  std::array<int, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return m[a][a] > m[b][b]; });
  values = {m[order[0]][order[0]], m[order[1]][order[1]], m[order[2]][order[2]]};
  axes = orthonormal({axes[order[0]], axes[order[1]], axes[order[2]]});
}

PrincipalFrame principal_frame(std::span<const Double3> points) {
  PrincipalFrame out;
  const double inverse = 1 / static_cast<double>(points.size());
  for (const Double3& p : points) out.mean += p;
  out.mean *= inverse;
  std::array<Double3, 3> m{};
  for (const Double3& p : points) {
    const Double3 d = p - out.mean;
    m[0].x += d.x * d.x, m[0].y += d.x * d.y, m[0].z += d.x * d.z;
    m[1].y += d.y * d.y, m[1].z += d.y * d.z, m[2].z += d.z * d.z;
  }
  for (Double3& row : m) row *= inverse;
  principal_axes(m, out.axes, out.variances);
  return out;
}

}  // namespace copse
