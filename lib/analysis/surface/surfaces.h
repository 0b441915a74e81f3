// surfaces: the connected surfaces of a trunk, each with its triangles and vertices.
#pragma once

#include "lib/analysis/surface/trunk_mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// Surface s has triangles triangle[first_triangle[s] .. first_triangle[s + 1]) and vertices likewise, both
// ascending. Surfaces are numbered by first triangle.
struct Surfaces {
  std::vector<std::uint32_t> first_triangle, triangle, first_vertex, vertex;

  std::uint32_t size() const { return static_cast<std::uint32_t>(first_triangle.size() - 1); }
  std::span<const std::uint32_t> triangles(std::uint32_t s) const {
    return std::span(triangle).subspan(first_triangle[s], first_triangle[s + 1] - first_triangle[s]);
  }
  std::span<const std::uint32_t> vertices(std::uint32_t s) const {
    return std::span(vertex).subspan(first_vertex[s], first_vertex[s + 1] - first_vertex[s]);
  }
};

Surfaces make_surfaces(const TrunkMesh& mesh);

}  // namespace copse
