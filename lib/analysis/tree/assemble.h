// A whole tree from its parts: header, trunk, leaves and groups, in the shape that tree_file.h stores.
#pragma once

#include "lib/analysis/tree/leaf_arrays.h"
#include "lib/analysis/tree/trunk_arrays.h"
#include "lib/formats/tree/tree.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// What hangs on the trunk: the answer of leaves/leaf_groups.h, as far as a file holds it.
struct TreeGroups {
  std::vector<LeafGroup> groups;
  std::vector<std::uint32_t> order;  // of the leaves, group after group
  std::vector<GroupNode> hierarchy;  // over the groups
  std::vector<std::uint32_t>
      group_of_radius;  // one a radius of the recovered hierarchy, k_none for none; or empty
};

struct AssembleOptions {
  TreeKind kind = TreeKind::sensitive;
  LeafOrder leaf_order = LeafOrder::group;
};

struct AssembleInput {
  const Mesh& mesh;
  const TrunkMesh& trunk;
  const Hierarchy& hierarchy;
  const LeafGeometry& leaves;
  const TreeGroups& groups;
  Double3 origin;
  // Of the mesh's materials: named by it, but defined nowhere.
  std::span<const std::uint32_t> undefined_materials{};
};

struct Assembled {
  Tree tree;
  std::uint64_t mixed_materials = 0;  // leaves that use several materials: their first one is kept
};

// Where positions are stored relative to: the origin itself as long as float32 resolves 2^-20 of the box's
// size there, otherwise the middle of the box's bottom, in whole units. So near trees keep their coordinates
// to the bit.
Double3 choose_origin(const DoubleBox& bounds);

// Materials are copied as they are in the mesh, textures too; what has none, or one that nothing defines,
// gets a default (default_materials.h). The cost is that of make_trunk_arrays and make_leaf_arrays.
Assembled assemble(const AssembleInput& input, const AssembleOptions& options);

}  // namespace copse
