// Facts about a mesh that the tests of treegrow compare with what it claims. Nothing here knows how the
// generator works: only triangles, positions and names.
#pragma once

#include "lib/formats/mesh.h"
#include "tools/treegrow/treegrow.h"

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace copse::grow {

// A species small and quick enough to try everything on.
Order small_order(const std::string& species, const std::string& breaks, std::uint64_t triangles = 4000,
                  std::uint64_t seed = 1);
Grown small_tree(const std::string& species, const std::string& breaks, std::uint64_t triangles = 4000,
                 std::uint64_t seed = 1);

// By the name of a triangle's object: leaves are "…_leaves".
bool is_leaf(const Mesh& mesh, std::size_t triangle);
std::vector<Triangle> trunk_triangles(const Mesh& mesh);
std::vector<Triangle> leaf_triangles(const Mesh& mesh);

// Vertices in exactly the same place become one.
struct Welded {
  std::vector<Double3> positions;
  std::vector<Triangle> triangles;
};
Welded welded(const Mesh& mesh, const std::vector<Triangle>& triangles);

// Pieces of a surface that hang together by shared vertex indices.
std::size_t pieces(const std::vector<Triangle>& triangles);

// How many triangles use each edge.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges(const std::vector<Triangle>& triangles);
std::size_t open_edges(const std::vector<Triangle>& triangles);

}  // namespace copse::grow
