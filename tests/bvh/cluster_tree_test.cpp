#include "lib/analysis/bvh/cluster_tree.h"

#include "tests/bvh/boxes.h"

namespace copse {
namespace {

TEST(ClusterTree, IsSoundAndBinaryForAnyCount) {
  for (const std::uint32_t n : {1u, 2u, 3u, 10u, 33u, 1000u})
    expect_sound(cluster_tree(random_boxes(n, n)), n, 2);
  EXPECT_EQ(cluster_tree({}), BoxTree());
}

TEST(ClusterTree, JoinsWhatLiesTogetherFirst) {
  std::vector<DoubleBox> boxes;
  for (const double x : {0.0, 100.0, 1.0, 101.0, 50.0}) boxes.push_back({{x, 0, 0}, {x + 0.5, 0.5, 0.5}});
  const BoxTree tree = cluster_tree(boxes);
  std::vector<std::vector<std::uint32_t>> pairs;
  for (const BoxNode& node : tree.nodes) {
    if (node.count != 2) continue;
    std::vector<std::uint32_t> pair(tree.order.begin() + node.first, tree.order.begin() + node.first + 2);
    std::sort(pair.begin(), pair.end());
    pairs.push_back(pair);
  }
  std::sort(pairs.begin(), pairs.end());
  EXPECT_EQ(pairs, (std::vector<std::vector<std::uint32_t>>{{0, 2}, {1, 3}}));
}

TEST(ClusterTree, EqualBoxesGiveALowTree) {
  const std::vector<DoubleBox> same(1024, DoubleBox{{0, 0, 0}, {1, 1, 1}});
  const BoxTree tree = cluster_tree(same);
  expect_sound(tree, 1024, 2);
  EXPECT_EQ(depth(tree), 10u);
}

TEST(ClusterTree, PointsAndHugeBoxesAreNoSpecialCase) {
  std::vector<DoubleBox> points;
  for (int i = 0; i < 200; ++i) points.push_back({{i * 1.0, 0, 0}, {i * 1.0, 0, 0}});
  expect_sound(cluster_tree(points), 200, 2);
  std::vector<DoubleBox> huge = random_boxes(200, 2);
  for (DoubleBox& b : huge) b = {b.min * 1e300, b.max * 1e300};
  expect_sound(cluster_tree(huge), 200, 2);
}

}  // namespace
}  // namespace copse
