#include "lib/analysis/boxes/minimal_rectangle.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace copse {
namespace {

double turn(const Double2& a, const Double2& b, const Double2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

void add_corner(std::vector<Double2>& chain, const Double2& p, std::size_t floor) {
  while (chain.size() >= floor + 2 && turn(chain[chain.size() - 2], chain.back(), p) <= 0) chain.pop_back();
  chain.push_back(p);
}

}  // namespace

std::vector<Double2> hull_of_plane(std::span<const Double2> points) {
  std::vector<Double2> sorted(points.begin(), points.end());
  std::sort(sorted.begin(), sorted.end(),
            [](const Double2& a, const Double2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  if (sorted.size() < 2) return sorted;
  std::vector<Double2> chain;
  for (const Double2& p : sorted) add_corner(chain, p, 0);
  const std::size_t floor = chain.size() - 1;
  for (std::size_t i = sorted.size() - 1; i-- > 0;) add_corner(chain, sorted[i], floor);
  chain.pop_back();  // the first again
  return chain;
}

Rectangle minimal_rectangle(std::span<const Double2> hull) {
  const std::size_t n = hull.size();
  Rectangle best;
  if (n < 2) return best;
  if (n == 2) {
    const double dx = hull[1].x - hull[0].x, dy = hull[1].y - hull[0].y, l = std::hypot(dx, dy);
    return {{dx / l, dy / l}, 0};
  }
  best.area = std::numeric_limits<double>::infinity();
  // The farthest along the edge, across it, and against it: each only moves on as the edge turns.
  std::size_t right = 1, top = 1, left = 1;
  for (std::size_t i = 0; i < n; ++i) {
    const Double2 &a = hull[i], &b = hull[(i + 1) % n];
    const double l = std::hypot(b.x - a.x, b.y - a.y);
    const Double2 u{(b.x - a.x) / l, (b.y - a.y) / l};
    const auto along = [&](std::size_t k) { return hull[k % n].x * u.x + hull[k % n].y * u.y; };
    const auto across = [&](std::size_t k) { return hull[k % n].y * u.x - hull[k % n].x * u.y; };
    right = std::max(right, i + 1);
    while (right < i + n && along(right + 1) > along(right)) ++right;
    top = std::max(top, right);
    while (top < i + n && across(top + 1) > across(top)) ++top;
    left = std::max(left, top);
    while (left < i + n && along(left + 1) < along(left)) ++left;
    const double area = (along(right) - along(left)) * (across(top) - across(i));
    if (area < best.area) best = {u, area};
  }
  return best;
}

}  // namespace copse
