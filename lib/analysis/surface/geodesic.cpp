#include "lib/analysis/surface/geodesic.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace copse {

namespace {

// When the wave that has reached a and b (at times fa and fb) reaches c: of a straight front over the
// triangle if it arrives between the edges ca and cb, along the sooner edge otherwise.
double arrival(const Double3& a, double fa, const Double3& b, double fb, const Double3& c) {
  if (fa > fb) return arrival(b, fb, a, fa, c);
  const Double3 ca = a - c, cb = b - c;
  const double la = length(ca), lb = length(cb), along = std::min(fa + la, fb + lb), u = fb - fa;
  if (!(la > 0 && lb > 0)) return along;
  const double cosine = dot(ca / la, cb / lb), sine2 = 1 - cosine * cosine;
  const double p = lb * lb + la * la - 2 * la * lb * cosine;
  const double q = la * u * (lb * cosine - la);
  const double r = la * la * (u * u - lb * lb * sine2);
  const double root = q * q - p * r;
  if (!(p > 0) || root < 0) return along;
  const double t = (-q + std::sqrt(root)) / p;
  const double at = la * (t - u) / t;  // where the wave's ray comes from, measured along cb
  const bool between = t > u && at > lb * cosine && (cosine <= 0 || at < lb / cosine);
  return between ? std::min(along, fa + t) : along;
}

}  // namespace

Lists triangles_of_vertices(const Surface& surface) {
  Lists lists;
  lists.first.assign(surface.positions.size() + 1, 0);
  for (const Triangle& t : surface.triangles) {
    for (const std::uint32_t v : t) ++lists.first[v + 1];
  }
  for (std::size_t v = 0; v < surface.positions.size(); ++v) lists.first[v + 1] += lists.first[v];
  lists.items.resize(lists.first.back());
  std::vector<std::uint32_t> next(lists.first.begin(), lists.first.end() - 1);
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    for (const std::uint32_t v : surface.triangles[t]) lists.items[next[v]++] = t;
  }
  return lists;
}

std::vector<double> geodesic_distance(const Surface& surface, const Lists& triangles_of,
                                      std::span<const std::uint32_t> sources) {
  std::vector<double> f(surface.positions.size(), std::numeric_limits<double>::infinity());
  std::vector<std::uint8_t> is_final(f.size(), 0);
  using Arrival = std::pair<double, std::uint32_t>;
  std::priority_queue<Arrival, std::vector<Arrival>, std::greater<>> queue;
  for (const std::uint32_t v : sources) f[v] = 0, queue.emplace(0.0, v);
  const auto offer = [&](std::uint32_t v, double time) {
    if (time < f[v]) f[v] = time, queue.emplace(time, v);
  };
  while (!queue.empty()) {
    const auto [time, v] = queue.top();
    queue.pop();
    if (is_final[v]) continue;
    is_final[v] = 1;
    for (const std::uint32_t t : triangles_of[v]) {
      const Triangle& c = surface.triangles[t];
      const std::size_t i = c[0] == v ? 0 : c[1] == v ? 1 : 2;
      const std::uint32_t x = c[(i + 1) % 3], y = c[(i + 2) % 3];
      const Double3 &pv = surface.positions[v], &px = surface.positions[x], &py = surface.positions[y];
      if (!is_final[x]) offer(x, is_final[y] ? arrival(pv, time, py, f[y], px) : time + distance(pv, px));
      if (!is_final[y]) offer(y, is_final[x] ? arrival(pv, time, px, f[x], py) : time + distance(pv, py));
    }
  }
  return f;
}

}  // namespace copse
