#include "lib/analysis/bvh/box_tree.h"

#include "tests/bvh/boxes.h"

namespace copse {
namespace {

TEST(BoxTree, FlattensListsDepthFirst) {
  // 3 items below 4, which hangs with item 3 below the root 5
  const std::vector<std::vector<std::uint32_t>> inner{{0, 1, 2}, {4, 3}};
  const BoxTree tree = flatten(inner, 4, 5);
  ASSERT_EQ(tree.nodes.size(), 6u);
  EXPECT_EQ(tree.nodes[0], (BoxNode{6, k_none, 0, 4}));
  EXPECT_EQ(tree.nodes[1], (BoxNode{5, k_none, 0, 3}));
  EXPECT_EQ(tree.nodes[4], (BoxNode{5, 2, 2, 1}));
  EXPECT_EQ(tree.nodes[5], (BoxNode{6, 3, 3, 1}));
  EXPECT_EQ(depth(tree), 2u);
}

TEST(BoxTree, ListsOfOneChildArePassedThroughAndEmptyOnesDropped) {
  const std::vector<std::vector<std::uint32_t>> inner{{0}, {3}, {}, {4, 5, 1, 2}};
  const BoxTree tree = flatten(inner, 3, 6);
  expect_sound(tree, 3, 3);
  EXPECT_EQ(tree.nodes.size(), 4u);
  EXPECT_EQ(flatten(std::vector<std::vector<std::uint32_t>>{{}}, 0, 0), BoxTree());
}

TEST(BoxTree, ALongChainOfListsNeedsNoRecursion) {
  std::vector<std::vector<std::uint32_t>> inner;
  const std::uint32_t items = 200000;
  for (std::uint32_t i = 0; i + 1 < items; ++i) inner.push_back({i, i + 2 < items ? items + i + 1 : i + 1});
  const BoxTree tree = flatten(inner, items, items);
  EXPECT_EQ(tree.order.size(), items);
  EXPECT_EQ(depth(tree), items - 1);
}

TEST(BoxTree, FlatTreeHasOneLevel) {
  expect_sound(flat_tree(7), 7, 7);
  EXPECT_EQ(depth(flat_tree(7)), 1u);
  EXPECT_EQ(flat_tree(0), BoxTree());
  EXPECT_EQ(flat_tree(1).nodes.size(), 1u);
}

TEST(BoxTree, GroupedTreeKeepsTheGroupsAndHangsLooseItemsAtTheRoot) {
  const std::vector<std::uint32_t> group_of{7, 2, 7, k_none, 2, 9};
  const BoxTree tree = grouped_tree(group_of);
  expect_sound(tree, 6, 4);
  EXPECT_EQ(tree.order, (std::vector<std::uint32_t>{1, 4, 0, 2, 5, 3}));
  EXPECT_EQ(depth(tree), 2u);
}

TEST(BoxTree, NodeBoxesHoldExactlyWhatIsBelow) {
  const std::vector<DoubleBox> boxes = random_boxes(40, 3);
  const std::vector<std::uint32_t> group_of{0, 1, 2, 0, 1, 2, 0, 1, 2, 3, 3, 3, 3, 3, 4, 4, 4, 4, 4, 4,
                                            5, 5, 5, 6, 6, 6, 6, 6, 6, 6, 7, 7, 7, 7, 7, 7, 8, 8, 8, 8};
  const BoxTree tree = grouped_tree(group_of);
  const std::vector<DoubleBox> nodes = node_boxes(tree, boxes);
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    DoubleBox expected;
    for (std::uint32_t j = 0; j < tree.nodes[i].count; ++j)
      expected.grow(boxes[tree.order[tree.nodes[i].first + j]]);
    EXPECT_EQ(nodes[i], expected);
  }
}

}  // namespace
}  // namespace copse
