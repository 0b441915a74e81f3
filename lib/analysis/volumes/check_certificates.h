// check_certificates: whether the volumes that a tree's file calls certified do hold the vertices of their
// parts, in exact arithmetic.
#pragma once

#include "lib/formats/levels/foliage_cells.h"
#include "lib/formats/tree/tree.h"
#include "lib/formats/tree_file/tree_volumes.h"

#include <span>
#include <string>
#include <vector>

namespace copse {

// A line for each volume that does not: "VOLU[12]: sphere (minimal) of group 3 leaves 2 of 40 vertices
// outside", and one for each set whose part the tree does not have. Sets of nodes are judged by all parts
// below the node; envelopes by everywhere that their vertices come to under the sway that is stored with them
// (motion_envelope.h), or, where none is stored, by the vertices at rest. All must be sound (check_tree,
// check_volumes, check_foliage_cells). O(vertices x volumes); given up, with a line that says so, after 2^32
// of them.
std::vector<std::string> check_certificates(const Tree& tree, const TreeVolumes& volumes,
                                            const FoliageCells& cells = {});

// The sets whose parts the set of this node is to hold: those of the nodes at the bottom below it, in order.
// `nodes` depth first; of each only skip and set are looked at. O(nodes below).
std::vector<std::uint32_t> sets_below(std::span<const VolumeNode> nodes, std::uint32_t node);

}  // namespace copse
