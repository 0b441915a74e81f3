// Sets of boxes, and what every tree over them must satisfy.
#pragma once

#include "lib/analysis/bvh/box_tree.h"
#include "lib/formats/random.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace copse {

inline std::vector<DoubleBox> random_boxes(std::uint32_t n, std::uint64_t seed,
                                           const Double3& spread = {10, 4, 7}) {
  Random random(seed);
  std::vector<DoubleBox> boxes;
  for (std::uint32_t i = 0; i < n; ++i) {
    const Double3 c{random.around(0, spread.x), random.around(0, spread.y), random.around(0, spread.z)};
    const Double3 h{random.uniform(), random.uniform(), random.uniform()};
    boxes.push_back({c - h, c + h});
  }
  return boxes;
}

// Every item once, runs that agree with the nodes, every inner node with two children at least and `k` at
// most.
inline void expect_sound(const BoxTree& tree, std::uint32_t items, std::uint32_t k) {
  std::vector<std::uint32_t> sorted = tree.order;
  std::sort(sorted.begin(), sorted.end());
  ASSERT_EQ(sorted.size(), items);
  for (std::uint32_t i = 0; i < items; ++i) ASSERT_EQ(sorted[i], i);
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    const BoxNode& node = tree.nodes[i];
    ASSERT_GT(node.skip, i);
    ASSERT_LE(node.skip, tree.nodes.size());
    if (node.item != k_none) {
      EXPECT_EQ(node.skip, i + 1);
      ASSERT_EQ(node.count, 1u);
      EXPECT_EQ(tree.order[node.first], node.item);
      continue;
    }
    std::uint32_t children = 0, first = node.first;
    for (std::uint32_t c = i + 1; c < node.skip; c = tree.nodes[c].skip) {
      ++children;
      ASSERT_EQ(tree.nodes[c].first, first);
      first += tree.nodes[c].count;
      ASSERT_LE(tree.nodes[c].skip, node.skip);
    }
    EXPECT_EQ(first, node.first + node.count);
    EXPECT_GE(children, 2u);
    EXPECT_LE(children, k);
  }
}

}  // namespace copse
