// kd-tree and R-tree over the blocks of an ecosystem, for players that want another hierarchy than the
// quadtree of the thesis: boxes in depth-first order with skip indices.
//
// Source: digest 002, section 3, through lib/analysis/bvh. A node has k = 4 children.
#pragma once

#include "lib/formats/ecosystem/ecosystem.h"

#include <vector>

namespace copse {

// Over the blocks that have a box. Empty when none has.
std::vector<BlockNode> block_kd_tree(const Ecosystem& eco);
std::vector<BlockNode> block_rtree(const Ecosystem& eco);

}  // namespace copse
