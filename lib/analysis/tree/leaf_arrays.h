// The leaves' stored arrays: triangles leaf after leaf with their own vertices (digest 000, section 3.2,
// items 21-24).
#pragma once

#include "lib/formats/mesh.h"
#include "lib/formats/tree.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

struct LeafArrays {
  Leaves leaves;  // without groups, order and hierarchy
  FloatBox bounds;
  std::uint32_t leaf_factor = 0;
  std::uint64_t mixed_materials = 0;  // leaves whose triangles have several materials: the first one is kept
};

// `leaf_of`: one a mesh triangle, the leaf that it belongs to or k_none; every leaf 0 .. centres.size() - 1
// has at least one triangle. `centres`: one a leaf. Positions are stored relative to `origin`. Linear.
LeafArrays make_leaf_arrays(const Mesh& mesh, std::span<const std::uint32_t> leaf_of,
                            std::span<const Double3> centres, const Double3& origin);

}  // namespace copse
