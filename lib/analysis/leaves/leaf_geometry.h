// leaf_geometry: where each leaf is and how large it looks (digest 000, sections 1.4 and 3.1; erratum E11).
#pragma once

#include "lib/analysis/leaves/classify.h"
#include "lib/formats/mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

struct LeafGeometry {
  // Mesh triangles leaf after leaf, in their old order inside one: triangles[first[l] .. first[l + 1]).
  std::vector<std::uint32_t> first{0};  // leaves + 1
  std::vector<std::uint32_t> triangles;
  std::vector<Double3> centres;  // mean of the leaf's distinct positions (of its 3 vertices, for a triangle)
  std::vector<double> areas;     // of all its triangles, times the alpha coverage of its first one's material

  std::uint32_t count() const { return static_cast<std::uint32_t>(centres.size()); }
  std::span<const std::uint32_t> of(std::uint32_t leaf) const {
    return std::span(triangles).subspan(first[leaf], first[leaf + 1] - first[leaf]);
  }
};

// Linear, but for leaves of many triangles, whose positions are sorted. The sum over a leaf laid back to back
// counts both sides, as the triangles that are drawn do.
LeafGeometry leaf_geometry(const Mesh& mesh, std::span<const std::uint32_t> leaf_of,
                           std::uint32_t leaf_count);
inline LeafGeometry leaf_geometry(const Mesh& mesh, const Classification& classes) {
  return leaf_geometry(mesh, classes.leaf_of, classes.leaf_count);
}

}  // namespace copse
