// What of a tree follows from the rest of it: sizes, sums, enclosing spheres, orders by distance. A packed
// tree (tree_pack.h) does not store them; whoever changes a tree's vertices makes them anew with this.
#pragma once

#include "lib/formats/tree/tree.h"

#include <vector>

namespace copse {

// Fills, from what is there:
//   of the header: both boxes, mean areas, area-density centre, monotone, and the constants k, segment factor
//   and leaf factor (first_vector and first_triangle hold offsets when called, and become empty when their
//   steps are all alike);
//   of radii: distance and outer radius;
//   lengths and diameters of the segments; centres of the leaves;
//   of groups: radius and mean area (its centre is given), the order of their leaves where the header says
//   LeafOrder::group (otherwise it is given), and radii of the hierarchy over them (centres are given).
// What contains is rounded outward. Preconditions: indices are in range, coordinates finite, materials are
// there, groups tile the leaves, segments are in order. Only + - * / and square roots: the same everywhere.
void derive(Tree& tree);

// The segments of a hierarchy in their order: by the larger diameter of their two radii, then by child
// radius. Parent and child of each.
std::vector<std::array<std::uint32_t, 2>> segments_of(const Tree& tree);

}  // namespace copse
