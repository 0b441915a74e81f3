#include "lib/analysis/surface/hull_relaxation.h"

#include "lib/analysis/surface/welded_tolerances.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace copse {

// The system is diagonally dominant for weights up to a half, so that Gauss and Seidel's iteration converges.
std::vector<Double3> before_hull_relaxation(const std::vector<Double3>& moved, const Lists& neighbours,
                                            std::span<const double> weights, double factor) {
  std::vector<Double3> p = moved;
  for (int round = 0; round < k_relaxation_rounds; ++round) {
    double change = 0, size = 0;
    for (std::size_t v = 0; v < p.size(); ++v) {
      if (neighbours[v].empty()) continue;
      Double3 sum;
      for (const std::uint32_t n : neighbours[v]) sum += p[n];
      const double weight = weights[v] * factor;
      const double share = weight / static_cast<double>(neighbours[v].size() + 1);
      const Double3 next = (moved[v] - sum * share) / (1 - weight + share);
      if (!is_finite(next)) return {};
      change = std::max(change, distance(next, p[v]));
      size = std::max(size, distance(next, moved[v]));
      p[v] = next;
    }
    if (change <= k_relaxation_done * size) return p;
  }
  return {};
}

double undo_hull_relaxation(std::vector<Double3>& positions, const Lists& neighbours,
                            std::span<const double> weights,
                            const std::function<std::size_t(const std::vector<Double3>&)>& regular_rings,
                            std::size_t least) {
  constexpr int k_steps = 20;
  std::size_t most = regular_rings(positions) + std::max<std::size_t>(least, 1);
  std::vector<Double3> best;
  double factor = 0;
  for (int step = 1; step <= k_steps; ++step) {
    const double tried = static_cast<double>(step) / k_steps;
    std::vector<Double3> p = before_hull_relaxation(positions, neighbours, weights, tried);
    if (p.empty()) continue;
    const std::size_t regular = regular_rings(p);
    if (regular < most) continue;
    most = regular + 1;
    best = std::move(p);
    factor = tried;
  }
  if (factor > 0) positions = std::move(best);
  return factor;
}

}  // namespace copse
