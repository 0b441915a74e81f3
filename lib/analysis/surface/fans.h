// fans: the triangles at each vertex, and which triangles repeat another one.
#pragma once

#include "lib/formats/mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// The triangles round vertex v are triangle[first[v] .. first[v + 1]), ascending, repeated ones left out.
struct Fans {
  std::vector<std::uint32_t> first, triangle;
  // (triangle, the lowest triangle with the same three vertices, whatever its winding), for each repeated
  // one: double-sided exports and tubes that a generator laid twice. Ascending.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> repeated;

  std::span<const std::uint32_t> of(std::uint32_t vertex) const {
    return std::span(triangle).subspan(first[vertex], first[vertex + 1] - first[vertex]);
  }
};

// Cost: O(n), plus the sort of the triangles that share their lowest vertex (a handful a vertex).
Fans make_fans(std::size_t vertices, std::span<const Triangle> triangles);

}  // namespace copse
