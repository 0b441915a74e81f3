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

TEST(BoxTree, NestedTreeKeepsTheGroupsAndHangsLooseItemsAtTheRoot) {
  // 0 holds items 0 and 2, and 1, which holds items 1 and 4; 2 holds 3, which holds nothing; 4 holds item 5
  const std::vector<std::uint32_t> parents{k_none, 0, k_none, 2, k_none}, group_of{0, 1, 0, k_none, 1, 4};
  const BoxTree tree = nested_tree(parents, group_of);
  expect_sound(tree, 6, 4);
  EXPECT_EQ(tree.order, (std::vector<std::uint32_t>{3, 0, 2, 1, 4, 5}));
  EXPECT_EQ(depth(tree), 3u);
  EXPECT_EQ(nested_tree(parents, {}), BoxTree());
}

TEST(BoxTree, AChainOfAHundredThousandGroupsNeedsNoRecursion) {
  std::vector<std::uint32_t> parents{k_none}, group_of{0};
  for (std::uint32_t g = 1; g < 100'000; ++g) parents.push_back(g - 1), group_of.push_back(g);
  const BoxTree tree = nested_tree(parents, group_of);
  EXPECT_EQ(tree.order.size(), parents.size());
  EXPECT_EQ(depth(tree), parents.size() - 1);
}

TEST(BoxTree, NodeBoxesHoldExactlyWhatIsBelow) {
  const std::vector<DoubleBox> boxes = random_boxes(40, 3);
  const std::vector<std::uint32_t> group_of{0, 1, 2, 0, 1, 2, 0, 1, 2, 3, 3, 3, 3, 3, 4, 4, 4, 4, 4, 4,
                                            5, 5, 5, 6, 6, 6, 6, 6, 6, 6, 7, 7, 7, 7, 7, 7, 8, 8, 8, 8};
  const std::vector<std::uint32_t> parents{k_none, k_none, k_none, 0, 0, 3, 1, 1, 7};
  const BoxTree tree = nested_tree(parents, group_of);
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
