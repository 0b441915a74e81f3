#include "lib/analysis/lod/foliage_cells_tree.h"

#include "tests/lod/leafy_tree.h"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

namespace copse {
namespace {

void expect_partition(const CellCut& cut, std::uint32_t leaves) {
  std::uint32_t at = 0;
  for (const FoliageCell& c : cut.cells) {
    EXPECT_EQ(c.first, at);
    EXPECT_GT(c.count, 0u);
    at += c.count;
  }
  EXPECT_EQ(at, leaves);
  std::vector<std::uint32_t> sorted = cut.leaves, all(leaves);
  std::iota(all.begin(), all.end(), 0u);
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(sorted, all);
}

TEST(FoliageCellsTree, EveryLeafIsInOneCellAndInsideItsBox) {
  const Tree tree = LeafyTree{}.make();
  const CellCut cut = cut_cells(tree, 32);
  EXPECT_EQ(cut.cells.size(), 32u);
  expect_partition(cut, 200);
  for (const FoliageCell& c : cut.cells) {
    for (std::uint32_t i = c.first; i < c.first + c.count; ++i) {
      for (std::uint32_t v = 4 * cut.leaves[i]; v < 4 * cut.leaves[i] + 4; ++v) {
        const Double3 d = to_double(tree.leaves.vertices[v]) - to_double(c.box.centre);
        for (int a = 0; a < 3; ++a)
          EXPECT_LE(std::abs(dot(to_double(c.box.axes[a]), d)), c.box.half_extents[a])
              << "cell of leaf " << cut.leaves[i];
      }
    }
  }
}

TEST(FoliageCellsTree, MoreCellsAreSmaller) {
  const Tree tree = LeafyTree{.leaves = 1000}.make();
  double before = 1e9;
  for (const std::uint32_t n : {1u, 8u, 64u}) {
    double largest = 0;
    for (const FoliageCell& c : cut_cells(tree, n).cells)
      largest = std::max<double>({largest, c.box.half_extents.x, c.box.half_extents.y, c.box.half_extents.z});
    EXPECT_LT(largest, 0.8 * before);
    before = largest;
  }
}

TEST(FoliageCellsTree, LeavesInOnePlaceStayInOneCell) {
  const CellCut cut = cut_cells(LeafyTree{.leaves = 30, .half = 0, .radius = 0}.make(), 8);
  EXPECT_EQ(cut.cells.size(), 1u);
  expect_partition(cut, 30);
}

TEST(FoliageCellsTree, NeverMoreCellsThanLeaves) {
  const CellCut cut = cut_cells(LeafyTree{.leaves = 5, .groups = 1}.make(), 100);
  EXPECT_EQ(cut.cells.size(), 5u);
  expect_partition(cut, 5);
  EXPECT_TRUE(cut_cells(Tree{}, 8).cells.empty());
}

}  // namespace
}  // namespace copse
