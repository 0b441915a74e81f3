#include "lib/analysis/bvh/kd_tree.h"

#include "tests/bvh/boxes.h"

#include <cmath>

namespace copse {
namespace {

TEST(KdTree, IsSoundAndBalancedForEveryBranchingOfTheDissertation) {
  for (const std::uint32_t k : {2u, 3u, 4u, 8u, 16u}) {
    for (const std::uint32_t n : {1u, 2u, 3u, 15u, 16u, 17u, 500u}) {
      const BoxTree tree = kd_tree(random_boxes(n, n), k);
      expect_sound(tree, n, k);
      EXPECT_LE(depth(tree), std::ceil(std::log(n) / std::log(k) + 1e-9)) << n << " " << k;
    }
  }
}

TEST(KdTree, CutsAlongTheAxisOnWhichCentresSpreadMost) {
  std::vector<DoubleBox> boxes;
  for (const double z : {3.0, 1.0, 2.0, 0.0}) boxes.push_back({{-100, 0, z}, {100, 1, z + 0.5}});
  const BoxTree tree = kd_tree(boxes, 2);
  EXPECT_EQ(tree.order, (std::vector<std::uint32_t>{3, 1, 2, 0}));  // wide boxes, but centres differ in z
  EXPECT_EQ(tree.nodes[1].count, 2u);
}

TEST(KdTree, GroupsAreOfEqualCount) {
  const BoxTree tree = kd_tree(random_boxes(100, 4), 3);
  std::vector<std::uint32_t> counts;
  for (std::uint32_t c = 1; c < tree.nodes[0].skip; c = tree.nodes[c].skip)
    counts.push_back(tree.nodes[c].count);
  EXPECT_EQ(counts, (std::vector<std::uint32_t>{33, 33, 34}));
}

TEST(KdTree, EqualCentresEndAndKeepTheirOrder) {
  const std::vector<DoubleBox> boxes(1000, DoubleBox{{0, 0, 0}, {1, 1, 1}});
  const BoxTree tree = kd_tree(boxes, 4);
  expect_sound(tree, 1000, 4);
  EXPECT_TRUE(std::is_sorted(tree.order.begin(), tree.order.end()));
}

TEST(KdTree, NothingGivesNothing) {
  EXPECT_EQ(kd_tree({}, 2), BoxTree());
}

TEST(KdTree, ScaleChangesNothing) {
  std::vector<DoubleBox> boxes = random_boxes(300, 5);
  const BoxTree tree = kd_tree(boxes, 4);
  for (const double scale : {0x1p-200, 0x1p900}) {
    std::vector<DoubleBox> scaled = boxes;
    for (DoubleBox& b : scaled) b = {b.min * scale, b.max * scale};
    EXPECT_EQ(kd_tree(scaled, 4), tree) << scale;
  }
}

}  // namespace
}  // namespace copse
