#include "lib/analysis/boxes/kdop.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace copse {
namespace {

// The directions with so many components that are not 0.
void add_diagonals(int components, std::vector<Double3>& normals) {
  for (int x = 0; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x * x + y * y + z * z != components) continue;
        // Of two opposite directions the one whose first component is positive.
        if (x == 0 && (y < 0 || (y == 0 && z < 0))) continue;
        normals.push_back({double(x), double(y), double(z)});
      }
    }
  }
}

std::vector<Double3> spiral(int n) {
  std::vector<Double3> normals;
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  for (int i = 0; i < n; ++i) {
    const double z = (i + 0.5) / n, r = std::sqrt(1 - z * z);
    normals.push_back({r * std::cos(golden * i), r * std::sin(golden * i), z});
  }
  return normals;
}

}  // namespace

std::vector<Double3> kdop_normals(int k) {
  std::vector<Double3> normals;
  if (k == 6 || k == 14 || k == 18 || k == 26) normals = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  if (k == 8 || k == 14 || k == 26) add_diagonals(3, normals);
  if (k == 12 || k == 18 || k == 26) add_diagonals(2, normals);
  return normals.empty() ? spiral(k / 2) : normals;
}

Kdop<double> fit_kdop(std::span<const Double3> points, std::vector<Double3> normals) {
  Kdop<double> kdop{std::move(normals), {}, {}};
  for (const Double3& n : kdop.normals) {
    double low = dot(n, points[0]), high = low;
    for (const Double3& p : points) {
      const double d = dot(n, p);
      low = std::min(low, d), high = std::max(high, d);
    }
    kdop.min.push_back(low), kdop.max.push_back(high);
  }
  return kdop;
}

}  // namespace copse
