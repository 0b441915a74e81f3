#include "lib/analysis/lod/radius_ancestors.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

// 0 -> 1 -> {2, 3}, 2 -> 4; groups 0 and 1 hang on 3 and 4, group 2 on nothing.
Tree fork() {
  Tree tree;
  tree.header.roots = 1;
  std::vector<Radius> r(5);
  r[0].first_child = 1, r[0].child_count = 1;
  r[1].first_child = 2, r[1].child_count = 2;
  r[2].first_child = 4, r[2].child_count = 1;
  r[3].flags = Radius::terminal, r[3].first_child = 0, r[3].child_count = 1;
  r[4].flags = Radius::terminal, r[4].first_child = 1, r[4].child_count = 1;
  tree.hierarchy.radii = r;
  tree.leaves.groups = std::vector<LeafGroup>(3);
  return tree;
}

TEST(RadiusAncestors, FindsTheLowestThatBearsBoth) {
  const RadiusAncestors a(fork());
  EXPECT_EQ(a.common(3, 4), 1u);
  EXPECT_EQ(a.common(2, 4), 2u);
  EXPECT_EQ(a.common(4, 4), 4u);
  EXPECT_EQ(a.common(0, 4), 0u);
}

TEST(RadiusAncestors, KnowsWhatEachGroupHangsOn) {
  EXPECT_EQ(RadiusAncestors(fork()).of_group(), (std::vector<std::uint32_t>{3, 4, k_none}));
}

TEST(RadiusAncestors, OfWhatIsNoRadiusIsNone) {
  const RadiusAncestors a(fork());
  EXPECT_EQ(a.common(k_none, 2), k_none);
  EXPECT_EQ(a.common(2, 99), k_none);
  EXPECT_EQ(RadiusAncestors(Tree{}).common(0, 1), k_none);
}

}  // namespace
}  // namespace copse
