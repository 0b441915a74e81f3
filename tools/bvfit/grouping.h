// --hierarchy original: the grouping that the input came with.
#pragma once

#include "tools/bvfit/input.h"

#include <array>
#include <span>
#include <vector>

namespace copse::bvfit {

struct Grouping {
  std::vector<std::uint32_t> parents;  // of each group an earlier one, k_none at the top
  // The group of each segment, leaf group and foliage cell of a tree; empty of a scene, whose parts know.
  std::vector<std::uint32_t> of_segment, of_leaf_group;
  std::uint32_t of_cells = k_none;

  std::uint32_t group_of(const PartSet& part) const;
};

// Groups, objects and nodes as the files have them.
Grouping grouping_of_scene(std::span<const SourceGroup> groups);

// The limbs, in each its segments, the leaf groups at its radii and the limbs that grow from it; cells, which
// cut across limbs, apart. A tree without a hierarchy (.tree) has no limbs: segments, leaf groups and cells
// apart.
Grouping grouping_of_tree(const Tree& tree);

}  // namespace copse::bvfit
