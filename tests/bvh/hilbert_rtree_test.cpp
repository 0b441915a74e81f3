#include "lib/analysis/bvh/hilbert_rtree.h"

#include "tests/bvh/boxes.h"

#include <cmath>

namespace copse {
namespace {

TEST(HilbertRtree, TheCurveVisitsEveryCellAndStepsFromNeighbourToNeighbour) {
  for (const int bits : {1, 2, 4}) {
    const std::uint32_t side = 1u << bits;
    std::vector<std::array<std::uint32_t, 3>> at(side * side * side, {side, side, side});
    for (std::uint32_t x = 0; x < side; ++x) {
      for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t z = 0; z < side; ++z) {
          const std::uint64_t i = hilbert_index({x, y, z}, bits);
          ASSERT_LT(i, at.size());
          ASSERT_EQ(at[i][0], side) << "visited twice";
          at[i] = {x, y, z};
        }
      }
    }
    for (std::size_t i = 1; i < at.size(); ++i) {
      int steps = 0;
      for (int c = 0; c < 3; ++c)
        steps += std::abs(static_cast<int>(at[i][c]) - static_cast<int>(at[i - 1][c]));
      ASSERT_EQ(steps, 1) << i;
    }
  }
}

TEST(HilbertRtree, NodesArePackedFull) {
  for (const std::uint32_t k : {2u, 4u, 8u}) {
    const std::uint32_t n = k * k * k;
    const BoxTree tree = hilbert_rtree(random_boxes(n, k), k);
    expect_sound(tree, n, k);
    EXPECT_EQ(depth(tree), 3u);
    EXPECT_EQ(tree.nodes.size(), n + n / k + n / k / k + 1);
  }
}

TEST(HilbertRtree, IsSoundForAnyCount) {
  for (const std::uint32_t n : {1u, 2u, 3u, 9u, 65u, 1001u}) {
    for (const std::uint32_t k : {2u, 4u, 8u}) expect_sound(hilbert_rtree(random_boxes(n, n), k), n, k);
  }
  EXPECT_EQ(hilbert_rtree({}, 4), BoxTree());
}

TEST(HilbertRtree, GroupsAreSmallerThanThoseOfTheOrderOfInput) {
  const std::vector<DoubleBox> boxes = random_boxes(4096, 8, {100, 100, 100});
  const BoxTree tree = hilbert_rtree(boxes, 4);
  const std::vector<DoubleBox> nodes = node_boxes(tree, boxes);
  double volume = 0, unsorted = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (tree.nodes[i].count != 4) continue;
    const Double3 e = nodes[i].extent();
    volume += e.x * e.y * e.z;
  }
  for (std::size_t i = 0; i < boxes.size(); i += 4) {
    DoubleBox box;
    for (std::size_t j = 0; j < 4; ++j) box.grow(boxes[i + j]);
    const Double3 e = box.extent();
    unsorted += e.x * e.y * e.z;
  }
  EXPECT_LT(volume, unsorted / 20);
}

TEST(HilbertRtree, EqualCentresKeepTheirOrderAndHugeCoordinatesDoNotOverflow) {
  const std::vector<DoubleBox> same(100, DoubleBox{{5, 5, 5}, {6, 6, 6}});
  const BoxTree tree = hilbert_rtree(same, 4);
  EXPECT_TRUE(std::is_sorted(tree.order.begin(), tree.order.end()));
  std::vector<DoubleBox> huge = random_boxes(50, 1);
  for (DoubleBox& b : huge) b = {b.min * 1e307, b.max * 1e307};
  expect_sound(hilbert_rtree(huge, 4), 50, 4);
}

}  // namespace
}  // namespace copse
