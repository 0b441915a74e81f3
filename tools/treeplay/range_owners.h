// Which segment or leaf each triangle of a tree's geometry belongs to.
#pragma once

#include "lib/formats/tree/tree.h"
#include "lib/runtime/tree_geometry.h"

#include <cstdint>
#include <vector>

namespace copse::treeplay {

// One list a range of make_geometry(tree), one entry a triangle, ascending: of the trunk its segment (the
// number of segments when none has it), of leaves the place of its leaf in the order of the groups.
std::vector<std::vector<std::uint32_t>> range_owners(const Tree& tree, const std::vector<DrawRange>& ranges);

// The leaf at each place of that order.
std::vector<std::uint32_t> leaves_in_order(const Tree& tree);

}  // namespace copse::treeplay
