// components: the connected pieces of a set of triangles.
#pragma once

#include "lib/formats/mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// Disjoint sets over 0 .. n - 1, without recursion; the root of a set is its lowest member.
class UnionFind {
 public:
  explicit UnionFind(std::size_t n);
  std::uint32_t find(std::uint32_t x) {
    while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
    return x;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a), b = find(b);
    if (a < b) parent_[b] = a;
    if (b < a) parent_[a] = b;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

struct Components {
  std::vector<std::uint32_t> of;  // one a triangle: its component, numbered by first triangle
  std::uint32_t count = 0;
};

// Triangles are connected when they share a vertex. With `welded` (one representative a vertex, as weld()
// gives them) vertices with the same representative are one. O(n alpha(n)).
Components connected_components(std::span<const Triangle> triangles,
                                std::span<const std::uint32_t> welded = {});

}  // namespace copse
