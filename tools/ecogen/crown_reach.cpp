#include "tools/ecogen/crown_reach.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <tbb/parallel_for.h>

namespace copse::ecogen {
namespace {

// The normal's y of the steepest triangle of a row of cells, however they are cut.
double least_up(const Terrain& t, std::uint32_t row) {
  double up = 1;
  const auto take = [&](const Double3& a, const Double3& b, const Double3& c) {
    const Double3 n = cross(b - a, c - a);
    if (const double size = length(n); size > 0) up = std::min(up, std::abs(n.y) / size);
  };
  for (std::uint32_t c = 1; c < t.columns; ++c) {
    const Double3 p = t.vertex(c - 1, row - 1), q = t.vertex(c, row - 1), s = t.vertex(c - 1, row),
                  u = t.vertex(c, row);
    take(p, q, s), take(q, u, s), take(p, q, u), take(p, u, s);
  }
  return up;
}

}  // namespace

SinCos steepest_slope(const Terrain& t) {
  std::vector<double> up(std::max(t.rows, 1u), 1);
  tbb::parallel_for(std::uint32_t{1}, std::max(t.rows, 1u), [&](std::uint32_t r) { up[r] = least_up(t, r); });
  const double least = *std::min_element(up.begin(), up.end());
  return {std::sqrt(1 - least * least), least};
}

double crown_reach(const FloatBox& box, const TypeSource& type, const SinCos& steepest) {
  if (box.empty()) return 0;
  const auto larger = [](float a, float b) { return std::max(std::abs(double{a}), std::abs(double{b})); };
  const double x = larger(box.min.x, box.max.x), z = larger(box.min.z, box.max.z);
  const double wide = std::sqrt(x * x + z * z), high = larger(box.min.y, box.max.y);
  const auto most = [](const ValueRange& r) { return std::max(std::abs(r.min), std::abs(r.max)); };
  const SinCos lean =
      type.tilt_to_ground ? steepest : sin_cos_degrees(std::min(most(type.pitch) + most(type.roll), 90.0));
  // A point so wide and high reaches farthest when it lies level; up to there the farther it leans the
  // farther.
  if (lean.sin * wide >= lean.cos * high) return std::sqrt(wide * wide + high * high);
  return wide * lean.cos + high * lean.sin;
}

}  // namespace copse::ecogen
