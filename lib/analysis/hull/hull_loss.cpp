#include "lib/analysis/hull/hull_loss.h"

#include <algorithm>
#include <array>

namespace copse {
namespace {

constexpr std::uint32_t k_none = static_cast<std::uint32_t>(-1);
constexpr double k_rounding = 1e-9;  // of the gauge

std::vector<std::array<std::uint32_t, 3>> neighbours_of(const ConvexHull& hull) {
  std::vector<std::array<std::uint32_t, 3>> neighbours(hull.faces.size(), {k_none, k_none, k_none});
  const auto add = [&](std::uint32_t face, std::uint32_t other) {
    *std::find(neighbours[face].begin(), neighbours[face].end() - 1, k_none) = other;
  };
  for (const HullEdge& e : hull.edges) add(e.left, e.right), add(e.right, e.left);
  return neighbours;
}

}  // namespace

HullLoss hull_loss(const ConvexHull& hull, std::span<const Double3> points) {
  Double3 middle;
  for (const Double3& v : hull.vertices) middle += v;
  middle = middle / static_cast<double>(hull.vertices.size());
  std::vector<Double3> facets;  // a with a . (x - middle) = 1 on the facet
  for (const auto& f : hull.faces) {
    const Double3 a = hull.vertices[f[0]], normal = cross(hull.vertices[f[1]] - a, hull.vertices[f[2]] - a);
    facets.push_back(normal / std::max(dot(normal, a - middle), 1e-300));
  }
  const auto neighbours = neighbours_of(hull);
  HullLoss loss;
  std::vector<double> most(facets.size(), 1);
  std::vector<Double3> farthest(facets.size());
  std::uint32_t at = 0;
  for (const Double3& p : points) {
    const Double3 d = p - middle;
    double gauge = dot(facets[at], d);
    for (std::size_t step = 0; step < facets.size(); ++step) {
      std::uint32_t next = at;
      for (const std::uint32_t f : neighbours[at]) {
        if (f != k_none && dot(facets[f], d) > gauge) gauge = dot(facets[f], d), next = f;
      }
      if (next == at) break;
      at = next;
    }
    // p / gauge is in the hull.
    if (gauge > 1) loss.distance = std::max(loss.distance, (1 - 1 / gauge) * length(d));
    if (gauge <= 1 - k_rounding) continue;
    loss.outside.push_back(p);
    if (gauge > most[at]) most[at] = gauge, farthest[at] = p;
  }
  for (std::size_t f = 0; f < facets.size(); ++f) {
    if (most[f] > 1) loss.farthest.push_back(farthest[f]);
  }
  return loss;
}

}  // namespace copse
