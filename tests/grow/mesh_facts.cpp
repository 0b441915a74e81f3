#include "tests/grow/mesh_facts.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

namespace copse::grow {

Order small_order(const std::string& species, const std::string& breaks, std::uint64_t triangles,
                  std::uint64_t seed) {
  Order order;
  order.species = find_species(species).value();
  order.seed = seed;
  order.triangles = triangles;
  order.breaks = parse_breaks(breaks).value();
  return order;
}

Grown small_tree(const std::string& species, const std::string& breaks, std::uint64_t triangles,
                 std::uint64_t seed) {
  Order order = small_order(species, breaks, triangles, seed);
  auto grown = grow_mesh(order);
  if (!grown) {  // a break that costs many triangles: as the species comes
    order.triangles = 0;
    grown = grow_mesh(order);
  }
  EXPECT_TRUE(grown.has_value()) << species << " " << breaks;
  return std::move(*grown);
}

bool is_leaf(const Mesh& mesh, std::size_t triangle) {
  return mesh.parts[mesh.part_of[triangle]].object.ends_with("_leaves");
}

std::vector<Triangle> trunk_triangles(const Mesh& mesh) {
  std::vector<Triangle> result;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (!is_leaf(mesh, t)) result.push_back(mesh.triangles[t]);
  return result;
}

std::vector<Triangle> leaf_triangles(const Mesh& mesh) {
  std::vector<Triangle> result;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (is_leaf(mesh, t)) result.push_back(mesh.triangles[t]);
  return result;
}

Welded welded(const Mesh& mesh, const std::vector<Triangle>& triangles) {
  Welded result;
  std::map<std::array<double, 3>, std::uint32_t> known;
  for (Triangle triangle : triangles) {
    for (std::uint32_t& corner : triangle) {
      const Double3 p = mesh.positions[corner];
      const auto [at, fresh] = known.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(known.size()));
      if (fresh) result.positions.push_back(p);
      corner = at->second;
    }
    result.triangles.push_back(triangle);
  }
  return result;
}

std::size_t pieces(const std::vector<Triangle>& triangles) {
  std::uint32_t most = 0;
  for (const Triangle& t : triangles) most = std::max({most, t[0] + 1, t[1] + 1, t[2] + 1});
  std::vector<std::uint32_t> up(most);
  std::iota(up.begin(), up.end(), 0u);
  const auto find = [&](std::uint32_t v) {
    while (up[v] != v) v = up[v] = up[up[v]];
    return v;
  };
  for (const Triangle& t : triangles) up[find(t[0])] = find(t[1]), up[find(t[1])] = find(t[2]);
  std::set<std::uint32_t> roots;
  for (const Triangle& t : triangles) roots.insert(find(t[0]));
  return roots.size();
}

std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges(const std::vector<Triangle>& triangles) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const Triangle& t : triangles)
    for (int c = 0; c < 3; ++c)
      if (t[c] != t[(c + 1) % 3]) ++uses[std::minmax(t[c], t[(c + 1) % 3])];
  return uses;
}

std::size_t open_edges(const std::vector<Triangle>& triangles) {
  const auto uses = edges(triangles);
  return static_cast<std::size_t>(
      std::count_if(uses.begin(), uses.end(), [](const auto& e) { return e.second == 1; }));
}

}  // namespace copse::grow
