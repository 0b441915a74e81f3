// The triangles of one part of a tree at full detail as a GPU draws them: one vertex for all corners that
// have the same vertex, normal and texture coordinate.
#pragma once

#include "lib/formats/levels/spectrum.h"
#include "lib/formats/tree/tree.h"

#include <cstdint>
#include <vector>

namespace copse {

struct PartTriangles {
  std::vector<SpectrumVertex> vertices;
  std::vector<std::uint32_t> position_of;               // of each vertex: the tree's vertex (trunk or leaf)
  std::vector<std::array<std::uint32_t, 3>> triangles;  // in the order of the file
  std::vector<std::uint32_t> materials;                 // one a triangle; k_none for none
};

// A corner without a normal gets the mean of the faces round its vertex, weighted by area ((0, 1, 0) where
// there is none). What was left out of the tree is left out here. Linear in the corners.
PartTriangles trunk_triangles(const Tree& tree);
// Leaf l has the triangles [tree.first_triangle_of_leaf(l), tree.first_triangle_of_leaf(l + 1)).
PartTriangles leaf_triangles(const Tree& tree);

}  // namespace copse
