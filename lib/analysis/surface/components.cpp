#include "lib/analysis/surface/components.h"

#include <algorithm>
#include <numeric>

namespace copse {

UnionFind::UnionFind(std::size_t n) : parent_(n) {
  std::iota(parent_.begin(), parent_.end(), 0u);
}

Components connected_components(std::span<const Triangle> triangles, std::span<const std::uint32_t> welded) {
  std::size_t vertices = welded.size();
  if (welded.empty()) {
    for (const Triangle& t : triangles) vertices = std::max<std::size_t>(vertices, std::ranges::max(t) + 1u);
  }
  const auto vertex = [&](std::uint32_t v) { return welded.empty() ? v : welded[v]; };
  UnionFind sets(vertices);
  for (const Triangle& t : triangles) {
    sets.unite(vertex(t[0]), vertex(t[1]));
    sets.unite(vertex(t[0]), vertex(t[2]));
  }
  Components components;
  components.of.reserve(triangles.size());
  std::vector<std::uint32_t> number(vertices, k_none);
  for (const Triangle& t : triangles) {
    std::uint32_t& id = number[sets.find(vertex(t[0]))];
    if (id == k_none) id = components.count++;
    components.of.push_back(id);
  }
  return components;
}

}  // namespace copse
