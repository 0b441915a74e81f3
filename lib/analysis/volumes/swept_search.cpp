#include "lib/analysis/volumes/swept_search.h"

#include "lib/analysis/volumes/frame.h"
#include "lib/analysis/volumes/principal_axes.h"

#include <algorithm>

namespace copse {
namespace {

constexpr double k_rough_gap = 0.05;
constexpr int k_rough_rounds = 2;
constexpr std::size_t k_finalists = 6;           // of 13
constexpr std::size_t k_lozenge_finalists = 14;  // of 27: the rough order is no more than a hint

constexpr std::size_t k_small_hull = 60;  // of fewer points all go on: they are quick, and misled easily

Axes about(const Axes& base, const Double3& direction) {
  const Double3 u = normalized(direction);
  const Double3 side = std::abs(u.x) < 0.7 ? Double3{1, 0, 0} : Double3{0, 1, 0};
  const Axes local = orthonormal({u, side, {}});
  return {out_of(base, local[0]), out_of(base, local[1]), out_of(base, local[2])};
}

// The axes, the face diagonals and the body diagonals.
std::vector<Axes> directions(const Axes& base) {
  std::vector<Axes> out;
  for (int x = 1; x >= -1; --x) {
    for (int y = 1; y >= -1; --y) {
      for (int z = 1; z >= -1; --z) {
        const bool half = x > 0 || (x == 0 && (y > 0 || (y == 0 && z > 0)));
        if (half) out.push_back(about(base, {double(x), double(y), double(z)}));
      }
    }
  }
  return out;
}

// The frames modulo the eight rotations of a rectangle: each axis of the base across, turned to the corners
// of a cube in the space of rotations, and not turned.
std::vector<Axes> frames(const Axes& base) {
  constexpr double k_turn = 0.2071;  // half of tan(pi / 8), the cube's half side
  std::vector<Axes> out;
  for (int k = 0; k < 3; ++k) {
    const Axes across{base[(k + 1) % 3], base[(k + 2) % 3], base[k]};
    out.push_back(across);
    for (int corner = 0; corner < 8; ++corner) {
      const auto sign = [&](int bit) { return corner >> bit & 1 ? -k_turn : k_turn; };
      out.push_back(turned(across, {sign(0), sign(1), sign(2)}));
    }
  }
  return out;
}

// The edges of the hull among all pairs of so few points; for a lozenge a finer grid of turns.
void add_starts(Swept kind, std::span<const Double3> points, const Axes& base, std::vector<Axes>& starts) {
  constexpr std::size_t k_few = 12;
  constexpr double k_turn = 0.2761;  // two thirds of tan(pi / 8): the middles of 27 cells
  if (points.size() > k_few) return;
  if (kind == Swept::lozenge) {
    for (int i = 0; i < 81; ++i) {
      const int k = i / 27;
      const Axes across{base[(k + 1) % 3], base[(k + 2) % 3], base[k]};
      starts.push_back(
          turned(across, {(i % 3 - 1) * k_turn, (i / 3 % 3 - 1) * k_turn, (i / 9 % 3 - 1) * k_turn}));
    }
    return;
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      if (points[i] != points[j]) starts.push_back(about(k_world_axes, points[j] - points[i]));
    }
  }
}

double cost(Swept kind, const SweptFit& fit) {
  return kind == Swept::line ? fit.rectangle.r : fit.volume();
}

}  // namespace

SweptFit search_around(Swept kind, std::span<const Double3> points) {
  const Axes base = principal_axes(points).axes;
  std::vector<std::pair<double, Axes>> scouts;
  std::vector<Axes> starts = kind == Swept::lozenge ? frames(base) : directions(base);
  add_starts(kind, points, base, starts);
  for (const Axes& start : starts) {
    const SweptFit fit = descend_around(kind, points, start, {k_rough_gap, k_rough_rounds});
    scouts.emplace_back(cost(kind, fit), fit.frame);
  }
  std::stable_sort(scouts.begin(), scouts.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  const std::size_t finalists = points.size() < k_small_hull ? scouts.size()
                                : kind == Swept::lozenge     ? k_lozenge_finalists
                                                             : k_finalists;
  SweptFit best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < scouts.size() && i < finalists; ++i) {
    const SweptFit fit = descend_around(kind, points, scouts[i].second);
    if (cost(kind, fit) < least) least = cost(kind, fit), best = fit;
  }
  return best;
}

}  // namespace copse
