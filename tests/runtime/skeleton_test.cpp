#include "lib/runtime/skeleton.h"

#include "tests/runtime/little_tree.h"

#include <numbers>

#include <gtest/gtest.h>

namespace copse {
namespace {

using testing::little_stree;
using testing::little_tree;

TEST(Skeleton, OfAnStreeHasALineFromEveryRadiusToItsParent) {
  const Skeleton s = make_skeleton(little_stree());
  ASSERT_EQ(s.lines.size(), 3u);
  EXPECT_EQ(s.lines[0], (SkeletonLine{{0, 0, 0}, {0, 1, 0}, 0.4f, 0.3f, 0, false}));
  EXPECT_EQ(s.lines[1], (SkeletonLine{{0, 1, 0}, {0, 2, 0}, 0.3f, 0.2f, 0, false}));
  EXPECT_EQ(s.lines[2], (SkeletonLine{{0, 1, 0}, {1, 1, 0}, 0.1f, 0.1f, 1, true}));
  EXPECT_EQ(s.levels, 2u);
}

TEST(Skeleton, HasAPointForEveryRadius) {
  const Skeleton s = make_skeleton(little_stree());
  ASSERT_EQ(s.points.size(), 4u);
  EXPECT_EQ(s.points[0], (SkeletonPoint{{0, 0, 0}, 0.4f, 0, true, false}));
  EXPECT_EQ(s.points[3], (SkeletonPoint{{1, 1, 0}, 0.1f, 1, false, true}));
}

TEST(Skeleton, OfATreeComesFromItsLines) {
  const Skeleton s = make_skeleton(little_tree());
  ASSERT_EQ(s.lines.size(), 2u);
  EXPECT_EQ(s.lines[0], (SkeletonLine{{0, 0, 0}, {0, 1, 0}, 0.4f, 0.3f, 0, false}));
  EXPECT_EQ(s.lines[1], (SkeletonLine{{0, 1, 0}, {0, 2, 0}, 0.3f, 0.3f, 0, false}));
}

TEST(Skeleton, PutsEveryLeafInItsGroupInTheOrderOfTheGroup) {
  const Skeleton s = make_skeleton(little_stree());
  ASSERT_EQ(s.leaves.size(), 2u);
  EXPECT_EQ(s.leaves[0].centre, (Float3{-0.25f, 2.25f, 0}));
  EXPECT_EQ(s.leaves[0].group, 0u);
  EXPECT_FLOAT_EQ(s.leaves[0].diameter * s.leaves[0].diameter * std::numbers::pi_v<float> / 4, 0.25f);
}

TEST(Skeleton, HangsAGroupOnItsTerminalRadius) {
  const Skeleton s = make_skeleton(little_stree());
  ASSERT_EQ(s.groups.size(), 1u);
  EXPECT_TRUE(s.groups[0].hangs);
  EXPECT_EQ(s.groups[0].terminal, (Float3{0, 2, 0}));
  EXPECT_FALSE(make_skeleton(little_tree()).groups[0].hangs);
}

TEST(Skeleton, TheThickestChildContinuesTheBranch) {
  Tree tree;
  tree.header.kind = TreeKind::sensitive;
  tree.header.roots = 1;
  tree.hierarchy.radii = std::vector<Radius>{{{}, 1, 1, 0, 1, 3, 0},
                                             {{1, 1, 0}, 0.3f, 1, 1, k_none, 0, Radius::terminal},
                                             {{0, 1, 0}, 0.7f, 1, 1, k_none, 0, Radius::terminal},
                                             {{2, 1, 0}, 0.7f, 1, 1, k_none, 0, Radius::terminal}};
  const Skeleton s = make_skeleton(tree);
  EXPECT_EQ(s.points[1].level, 1u);
  EXPECT_EQ(s.points[2].level, 0u);
  EXPECT_EQ(s.points[3].level, 1u);
}

TEST(Skeleton, AVineOfAHundredThousandSegmentsNeedsNoRecursion) {
  const std::uint32_t n = 100000;
  Tree tree = little_tree();
  std::vector<Float3> vertices;
  std::vector<std::array<std::uint32_t, 2>> lines;
  for (std::uint32_t i = 0; i <= n; ++i) vertices.push_back({0, static_cast<float>(i), 0});
  for (std::uint32_t i = n; i-- > 0;) lines.push_back({i, i + 1});
  tree.trunk.line_vertices = vertices;
  tree.trunk.lines = lines;
  tree.trunk.diameters = std::vector<float>(n, 0.1f);
  const Skeleton s = make_skeleton(tree);
  EXPECT_EQ(s.lines.size(), n);
  EXPECT_EQ(s.levels, 1u);
}

TEST(Skeleton, OfNothingIsNothing) {
  const Skeleton s = make_skeleton(Tree{});
  EXPECT_TRUE(s.lines.empty());
  EXPECT_TRUE(s.points.empty());
  EXPECT_EQ(s.levels, 0u);
}

}  // namespace
}  // namespace copse
