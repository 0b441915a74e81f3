// check_certificates: whether the volumes that a tree's file calls certified do hold the vertices of their
// parts, in exact arithmetic.
#pragma once

#include "lib/formats/tree.h"
#include "lib/formats/tree_volumes.h"

#include <string>
#include <vector>

namespace copse {

// A line for each volume that does not: "VOLU[12]: sphere (minimal) of group 3 leaves 2 of 40 vertices
// outside". Sets of nodes are judged by all parts below the node. Not judged: envelopes of a motion, which is
// not in the file, and foliage cells, which this does not read. Both must be sound (check_tree,
// check_volumes). O(vertices x volumes); given up, with a line that says so, after 2^32 of them.
std::vector<std::string> check_certificates(const Tree& tree, const TreeVolumes& volumes);

}  // namespace copse
