#include "lib/analysis/swept/force_plane.h"

#include <algorithm>

namespace copse {
namespace {

// 1 + |g|^2 at the place of the cell nearest to the origin.
double least_weight(const RotationCell& cell) {
  double sum = 1;
  for (int k = 0; k < 3; ++k) {
    const double nearest = std::clamp(0.0, cell.low[k], cell.high[k]);
    sum += nearest * nearest;
  }
  return sum;
}

}  // namespace

ForcePlane force_plane(std::span<const Double3> points, std::span<const std::uint32_t> which,
                       std::span<const Double3> forces) {
  ForcePlane plane;
  Double3 sum;
  double press = 0;
  for (const Double3& y : forces) sum += y, press += length(y);
  if (!(press > 0) || !std::isfinite(press)) return plane;
  double reach = 0;
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const Double3& p = points[which[i]];
    const Double3 y = forces[i] - sum * (length(forces[i]) / press);
    plane.alpha += std::abs(y.x) / 2;
    plane.beta += std::abs(y.y) / 2;
    plane.gamma += length(y);
    for (int k = 0; k < 3; ++k) plane.moment[k] += p * y[k];
    reach = std::max(reach, length(p));
  }
  // Of n terms a sum is off by n + 1 roundings of the sum of their sizes: the moments; what is left of the
  // balance, on either side of three coordinates; alpha, beta and gamma times lengths of up to twice the
  // reach. A fixed number more comes from the frame and from evaluating the polynomial.
  const double roundings = 16 * static_cast<double>(forces.size()) + 256;
  plane.slack = roundings * 0x1p-53 * plane.gamma * reach;
  return plane;
}

PlaneRange range_over(const ForcePlane& plane, const RotationCell& cell) {
  std::array<Double3, 3> m;  // sum of y p^T with p in the cell's frame
  for (int k = 0; k < 3; ++k) m[k] = into(cell.frame, plane.moment[k]);
  const double trace = m[0].x + m[1].y + m[2].z;
  const Double3 torque{m[2].y - m[1].z, m[0].z - m[2].x, m[1].x - m[0].y};
  std::array<Double3, 3> s;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) s[i][j] = m[i][j] + m[j][i] - (i == j ? trace : 0);
  }
  const auto times = [&](const Double3& v) { return Double3{dot(s[0], v), dot(s[1], v), dot(s[2], v)}; };
  // N(g) = trace + 2 torque . g + g . S g over 1 + g.g; about the centre c, with d = g - c:
  // N - N_c (1 + g.g) / (1 + c.c) is linear plus quadratic in d, and 0 at d = 0.
  const Double3 c = cell.centre(), half = (cell.high - cell.low) * 0.5, sc = times(c);
  const double at_centre = (trace + 2 * dot(torque, c) + dot(c, sc)) / (1 + dot(c, c));
  const Double3 linear = (torque + sc - c * at_centre) * 2;
  PlaneRange range;
  // A curvature that is dropped where it is positive leaves a function concave in each coordinate, which is
  // least at a corner.
  for (int i = 0; i < 3; ++i) {
    s[i][i] = std::min(0.0, s[i][i] - at_centre);
    range.drop[i] = std::abs(linear[i]) * half[i] - s[i][i] * half[i] * half[i];
  }
  double least = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Double3 d{corner & 1 ? half.x : -half.x, corner & 2 ? half.y : -half.y,
                    corner & 4 ? half.z : -half.z};
    least = std::min(least, dot(linear, d) + dot(d, times(d)));
  }
  range.least = at_centre + least / least_weight(cell) - plane.slack;
  return range;
}

}  // namespace copse
