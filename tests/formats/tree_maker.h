// Valid trees of any shape for tests and benchmarks: random numbers in every array, every invariant kept.
#pragma once

#include "lib/formats/tree/tree.h"

#include <cstdint>

namespace copse {

struct TreeShape {
  TreeKind kind = TreeKind::sensitive;
  std::uint32_t roots = 2;
  std::uint32_t radii = 14;
  std::uint32_t leaves = 11;
  std::uint32_t groups = 4;   // at most `leaves`
  std::uint32_t ring = 0;     // vertices a radius; 0: 1 to 5
  std::uint32_t segment = 0;  // triangles a segment; 0: 0 to 4
  std::uint32_t leaf = 0;     // triangles a leaf; 0: 1 to 3
  std::uint32_t joints = 0;   // one in how many radii is a joint; 0: none
  std::uint32_t materials = 3;
  std::uint32_t textures = 2;
  bool one_material = false;  // one for the trunk and one for all leaves
  bool normals = true;
  bool texcoords = true;
  LeafOrder leaf_order = LeafOrder::group;
};

Tree make_tree(const TreeShape& shape, std::uint64_t seed);

// Equal to the bit, array by array.
bool same(const Tree& a, const Tree& b);

}  // namespace copse
