#include "lib/analysis/volumes/choose.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace copse {
namespace {

constexpr double k_same = 1e-6;
// Of the size: as thick is what outward rounding to float32 makes of a flat thing that is tilted.
constexpr double k_flat = 8 * 0x1p-23;

// Of hits that are let through to those that are needed. Round what nothing hits at random (a point, and of
// rays a segment) all are needless, and no cost of a test outweighs that.
double needless(double value, double least) {
  if (least > 0) return value / least - 1;
  return value > 0 ? std::numeric_limits<double>::infinity() : 0;
}

}  // namespace

bool is_flat(const VolumeMeasures& m, double size) {
  return 2 * m.volume <= k_flat * size * m.surface;
}

TestCosts table_costs() {
  constexpr double k_add = 1, k_mul = 1.4, k_root = 5.5, k_planes = 3.5;
  constexpr double k_dot = 3 * k_mul + 3 * k_add;        // a plane's distance
  constexpr double k_transform = 9 * k_mul + 9 * k_add;  // of a point
  constexpr double k_sphere = k_transform + k_planes * k_dot;
  const auto relative = [&](double transforms, double test) {
    return (transforms * k_transform + k_planes * test) / k_sphere;
  };
  TestCosts c{};
  const auto set = [&](VolumeKind kind, double cost) { c.relative[static_cast<std::size_t>(kind)] = cost; };
  set(VolumeKind::aabb, relative(1, 6 * k_mul + 6 * k_add));  // its axes stay where they are
  set(VolumeKind::sphere, relative(1, k_dot));
  set(VolumeKind::obb, relative(4, 15 * k_mul + 11 * k_add));
  set(VolumeKind::capsule, relative(2, 6 * k_mul + 6 * k_add));
  set(VolumeKind::cylinder, relative(2, 11 * k_mul + 9 * k_add + k_root));
  set(VolumeKind::lozenge, relative(4, 12 * k_mul + 12 * k_add));
  set(VolumeKind::ellipsoid, relative(4, 15 * k_mul + 11 * k_add));
  set(VolumeKind::kdop, relative(1, 0));
  c.per_slab = relative(0, 2 * k_mul + 2 * k_add);
  return c;
}

std::size_t choose(std::span<const Candidate> candidates, Criterion criterion, const TestCosts& costs,
                   const ExpectedCost& expected, double size) {
  double surface = std::numeric_limits<double>::infinity(), width = surface;
  for (const Candidate& c : candidates) {
    surface = std::min(surface, c.measures.surface), width = std::min(width, c.measures.mean_width);
  }
  const auto value = [&](const Candidate& c) {
    const double volume = is_flat(c.measures, size) ? 0 : c.measures.volume, cost = costs.of(c);
    if (criterion == Criterion::weighted) return volume * cost;
    if (criterion != Criterion::expected) return volume;
    double hits = 0;  // a share of none counts nothing, however many needless hits it has
    if (expected.rays > 0) hits += expected.rays * needless(c.measures.surface, surface);
    if (expected.rays < 1) hits += (1 - expected.rays) * needless(c.measures.mean_width, width);
    return expected.content > 0 ? cost + expected.content * hits : cost;
  };
  double least = std::numeric_limits<double>::infinity();
  for (const Candidate& c : candidates) least = std::min(least, value(c));
  std::size_t best = candidates.size();
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (!(value(candidates[i]) <= least * (1 + k_same))) continue;
    if (best == candidates.size() || costs.of(candidates[i]) < costs.of(candidates[best])) best = i;
  }
  return std::min(best, candidates.size() - 1);
}

}  // namespace copse
