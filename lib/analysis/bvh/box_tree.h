// box_tree: a hierarchy over things that have boxes, as one array in depth-first order.
//
// Node 0 is the root. The nodes below node i are i + 1 .. nodes[i].skip - 1; its first child is i + 1, the
// next child is the first one's skip, and so on until nodes[i].skip. A traversal is a loop without a stack:
// i + 1 to enter a node, nodes[i].skip to leave it out. Every item has one bottom node of its own.
//
// Source: digest 002, section 3; kd_tree.h, hilbert_rtree.h and cluster_tree.h make these.
#pragma once

#include "lib/formats/material.h"
#include "lib/formats/vec.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

struct BoxNode {
  std::uint32_t skip = 0;       // the next node that is not below this one
  std::uint32_t item = k_none;  // of a bottom node, k_none inside
  std::uint32_t first = 0;      // the items below are order[first .. first + count)
  std::uint32_t count = 0;
  friend bool operator==(const BoxNode&, const BoxNode&) = default;
};

struct BoxTree {
  std::vector<BoxNode> nodes;        // empty when there is no item
  std::vector<std::uint32_t> order;  // the items, each once, as the bottom nodes come
  friend bool operator==(const BoxTree&, const BoxTree&) = default;
};

// From lists of children: an id below `items` is an item, `items` + n is inner node n. What hangs below
// `root` must be a tree (no id twice). Lists of one child are passed through, empty ones dropped. O(nodes).
BoxTree flatten(std::span<const std::vector<std::uint32_t>> inner, std::uint32_t items, std::uint32_t root);

// A root with all items below it.
BoxTree flat_tree(std::uint32_t items);

// The grouping that the items came with, however deep: a root, below it the groups, in each its items and
// then the groups in it, both in their order. parents: of each group an earlier one, k_none at the root.
// group_of: of each item, k_none at the root. Groups without items below them are left out. O(nodes).
BoxTree nested_tree(std::span<const std::uint32_t> parents, std::span<const std::uint32_t> group_of);

// The box of everything below each node. boxes: one an item. O(nodes).
std::vector<DoubleBox> node_boxes(const BoxTree& tree, std::span<const DoubleBox> boxes);

// Levels below the root: 0 for a lone item or nothing.
std::uint32_t depth(const BoxTree& tree);

}  // namespace copse
