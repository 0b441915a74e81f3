// group_hierarchy: bounding spheres over the leaf groups, to test many at once (digest 000, section 8, idea
// 2).
#pragma once

#include "lib/formats/tree/tree.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

enum class GroupBuilder : std::uint8_t {
  median,  // halves the groups along the longest axis of their centres: the baseline
  sweep,   // splits where the two halves' surface times their number of groups is least, then takes out nodes
           // whose test costs more than it saves: wider nodes where spheres would hardly shrink
};

// Depth first with skip pointers, as GroupNode says. A bottom node has its group's sphere; an inner node's
// is the smallest that encloses its children's, as float32 and proven (minimal_sphere.h): so a node's sphere
// encloses every sphere and every leaf below it. One group: one node. No recursion; depth at most
// 4 log2(groups) + 8; O(n log^2 n).
std::vector<GroupNode> group_hierarchy(std::span<const LeafGroup> groups,
                                       GroupBuilder builder = GroupBuilder::sweep);

// How many spheres are tested, on average over the planes or lines that meet the smallest sphere round all
// groups: the root and each node whose parent is met; a sphere is met in proportion to its surface (a nested
// sphere may be larger than the smallest: then it counts more than once). About the number of groups when
// the hierarchy saves nothing.
double expected_tests(std::span<const GroupNode> nodes);

}  // namespace copse
