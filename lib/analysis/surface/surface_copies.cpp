#include "lib/analysis/surface/surface_copies.h"

#include <algorithm>
#include <array>
#include <compare>

namespace copse {

namespace {

using Numbers = std::array<double, 3>;

Numbers numbers(const Double3& p) {
  return {p.x, p.y, p.z};
}

// What surfaces must have in common to be compared.
struct Outline {
  std::size_t triangles, vertices;
  Numbers min, max;
  std::uint32_t surface;
  auto operator<=>(const Outline&) const = default;
  bool matches(const Outline& o) const {
    return triangles == o.triangles && vertices == o.vertices && min == o.min && max == o.max;
  }
};

std::vector<Outline> outlines(const TrunkMesh& mesh, const Surfaces& surfaces) {
  std::vector<Outline> all;
  for (std::uint32_t s = 0; s < surfaces.size(); ++s) {
    DoubleBox box;
    for (const std::uint32_t v : surfaces.vertices(s)) box.grow(mesh.positions[v]);
    all.push_back(
        {surfaces.triangles(s).size(), surfaces.vertices(s).size(), numbers(box.min), numbers(box.max), s});
  }
  std::ranges::sort(all, [](const Outline& a, const Outline& b) { return std::is_lt(a <=> b); });
  return all;
}

// A surface by its positions alone: these in ascending order, its triangles as three of their ranks each,
// ascending, with the triangle, and its edges as two ranks, the rank of the third corner, and the triangle.
struct Shape {
  std::vector<Numbers> positions;
  std::vector<std::array<std::uint32_t, 4>> triangles, edges;

  // The triangle of this shape that one of the same positions lies on: that with the same corners or, where
  // its quad is cut by the other diagonal here, the lower half of the quad; k_none where there is none.
  std::uint32_t under(const std::array<std::uint32_t, 4>& t) const {
    const auto same = std::ranges::lower_bound(triangles, std::array{t[0], t[1], t[2], 0u});
    if (same != triangles.end() && (*same)[0] == t[0] && (*same)[1] == t[1] && (*same)[2] == t[2])
      return (*same)[3];
    // Two edges of the quad end in the corner that is missing here.
    std::vector<std::array<std::uint32_t, 2>> beyond;  // (third corner, triangle)
    for (const auto& [low, high] : {std::pair(t[0], t[1]), std::pair(t[0], t[2]), std::pair(t[1], t[2])}) {
      auto e = std::ranges::lower_bound(edges, std::array{low, high, 0u, 0u});
      for (; e != edges.end() && (*e)[0] == low && (*e)[1] == high; ++e) beyond.push_back({(*e)[2], (*e)[3]});
    }
    std::ranges::sort(beyond);
    const auto twice = std::ranges::adjacent_find(beyond, {}, [](const auto& b) { return b[0]; });
    return twice == beyond.end() ? k_none : (*twice)[1];
  }
};

Shape shape_of(const TrunkMesh& mesh, const Surfaces& surfaces, std::uint32_t s) {
  Shape shape;
  for (const std::uint32_t v : surfaces.vertices(s)) shape.positions.push_back(numbers(mesh.positions[v]));
  std::ranges::sort(shape.positions);
  for (const std::uint32_t t : surfaces.triangles(s)) {
    std::array<std::uint32_t, 4> ranks{};
    for (std::size_t c = 0; c < 3; ++c) {
      const auto at =
          std::ranges::lower_bound(shape.positions, numbers(mesh.positions[mesh.triangles[t][c]]));
      ranks[c] = static_cast<std::uint32_t>(at - shape.positions.begin());
    }
    std::sort(ranks.begin(), ranks.begin() + 3);
    ranks[3] = t;
    shape.triangles.push_back(ranks);
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t low = c == 0 ? 1 : 0, high = c == 2 ? 1 : 2;
      shape.edges.push_back({ranks[low], ranks[high], ranks[c], t});
    }
  }
  std::ranges::sort(shape.triangles);
  std::ranges::sort(shape.edges);
  return shape;
}

// Adds what the triangles of `copy` lie on; false, and nothing is added, where one lies on none.
bool match(const Shape& copy, const Shape& original,
           std::vector<std::pair<std::uint32_t, std::uint32_t>>& matched) {
  if (copy.positions != original.positions) return false;
  const std::size_t before = matched.size();
  for (const auto& t : copy.triangles) {
    const std::uint32_t under = original.under(t);
    if (under == k_none) {
      matched.resize(before);
      return false;
    }
    matched.emplace_back(t[3], under);
  }
  return true;
}

}  // namespace

SurfaceCopies find_surface_copies(const TrunkMesh& mesh, const Surfaces& surfaces) {
  SurfaceCopies copies;
  copies.original.assign(surfaces.size(), k_none);
  const std::vector<Outline> all = outlines(mesh, surfaces);
  for (std::size_t i = 0, end = 0; i < all.size(); i = end) {
    while (end < all.size() && all[end].matches(all[i])) ++end;
    if (end - i < 2) continue;
    // Of one outline few are different: each is compared with the first.
    const Shape first = shape_of(mesh, surfaces, all[i].surface);
    for (std::size_t j = i + 1; j < end; ++j) {
      if (match(shape_of(mesh, surfaces, all[j].surface), first, copies.triangles))
        copies.original[all[j].surface] = all[i].surface;
    }
  }
  std::ranges::sort(copies.triangles);
  return copies;
}

}  // namespace copse
