// The leaves' stored arrays: triangles leaf after leaf with their own vertices (digest 000, section 3.2,
// items 21-24).
#pragma once

#include "lib/analysis/leaves/leaf_geometry.h"
#include "lib/formats/mesh.h"
#include "lib/formats/tree/tree.h"

#include <cstdint>

namespace copse {

struct LeafArrays {
  Leaves leaves;  // without groups, order and hierarchy
  FloatBox bounds;
  std::uint32_t leaf_factor = 0;
  std::uint64_t mixed_materials = 0;  // leaves whose triangles have several materials: the first one is kept
};

// Positions are stored relative to `origin`; every leaf has at least one triangle. Linear.
LeafArrays make_leaf_arrays(const Mesh& mesh, const LeafGeometry& geometry, const Double3& origin);

}  // namespace copse
