#include "lib/analysis/tree/tree_parts.h"

#include "tests/formats/tree_maker.h"

#include <algorithm>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(TreeParts, TrunkAndLeavesMakeTheWhole) {
  const Tree tree = make_tree({}, 1);
  TreeParts parts(tree);
  EXPECT_EQ(parts.points().size(), trunk_vertices(tree).size() + tree.leaves.vertices.size());
  EXPECT_EQ(parts.part(VolumePart::whole).points.size(), parts.points().size());
  EXPECT_EQ(parts.part(VolumePart::trunk).points.size(), parts.trunk_points());
  EXPECT_EQ(parts.part(VolumePart::leaves).points.size(), tree.leaves.vertices.size());
  EXPECT_EQ(parts.part(VolumePart::whole).triangles.size(),
            tree.trunk.triangles.size() + tree.leaves.triangles.size());
}

TEST(TreeParts, EveryTriangleIsInOneSegmentOrOneGroup) {
  const Tree tree = make_tree({.radii = 30, .leaves = 25, .groups = 6}, 2);
  TreeParts parts(tree);
  std::size_t triangles = 0;
  for (std::uint32_t i = 0; i < parts.count(VolumePart::segment); ++i)
    triangles += parts.part(VolumePart::segment, i).triangles.size();
  EXPECT_EQ(triangles, tree.trunk.triangles.size());
  triangles = 0;
  std::set<std::uint32_t> seen;
  for (std::uint32_t i = 0; i < parts.count(VolumePart::group); ++i) {
    const TreePart part = parts.part(VolumePart::group, i);
    triangles += part.triangles.size();
    for (const std::uint32_t p : part.points) {
      EXPECT_GE(p, parts.trunk_points());
      seen.insert(p);
    }
    EXPECT_TRUE(std::set<std::uint32_t>(part.points.begin(), part.points.end()).size() == part.points.size());
    for (const Triangle& t : part.triangles)
      EXPECT_LT(*std::max_element(t.begin(), t.end()), part.points.size());
  }
  EXPECT_EQ(triangles, tree.leaves.triangles.size());
  std::set<std::uint32_t> used;
  for (const CornerTriangle& t : tree.leaves.triangles) {
    for (const std::uint32_t v : t.vertex) used.insert(v + parts.trunk_points());
  }
  EXPECT_EQ(seen, used);
}

TEST(TreeParts, CellsTileTheLeaves) {
  const Tree tree = make_tree({.leaves = 25, .groups = 6}, 2);
  FoliageCells cells;
  std::vector<FoliageCell> cut(3);
  cut[0].count = 5, cut[1].first = 5, cut[1].count = 0, cut[2].first = 5, cut[2].count = 20;
  std::vector<std::uint32_t> order(25);
  std::iota(order.rbegin(), order.rend(), 0u);
  cells.cells = cut, cells.order = order;
  TreeParts parts(tree, &cells);
  ASSERT_EQ(parts.count(VolumePart::cell), 3u);
  EXPECT_TRUE(parts.part(VolumePart::cell, 1).points.empty());
  EXPECT_EQ(
      parts.part(VolumePart::cell, 0).triangles.size() + parts.part(VolumePart::cell, 2).triangles.size(),
      tree.leaves.triangles.size());
  EXPECT_EQ(TreeParts(tree).count(VolumePart::cell), 0u);
}

TEST(TreeParts, GroupsWithoutTheirLeavesHaveNoPoints) {
  Tree tree = make_tree({}, 3);
  tree.leaves.order = {};
  TreeParts parts(tree);
  EXPECT_FALSE(parts.groups_have_leaves());
  EXPECT_TRUE(parts.part(VolumePart::group, 0).points.empty());
}

}  // namespace
}  // namespace copse
