#include "lib/analysis/lod/limb_chains.h"

#include "tests/lod/tube_tree.h"

#include <set>

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(LimbChains, EverySegmentIsInExactlyOneLimb) {
  const Tree tree = stem_with_twigs(5, 6, 7);
  std::multiset<std::uint32_t> seen;
  for (const LimbChain& limb : limb_chains(tree)) {
    ASSERT_EQ(limb.radii.size(), limb.segments.size() + 1);
    for (std::size_t i = 0; i < limb.segments.size(); ++i) {
      seen.insert(limb.segments[i]);
      EXPECT_EQ(tree.trunk.lines[limb.segments[i]], (std::array{limb.radii[i], limb.radii[i + 1]}));
    }
  }
  EXPECT_EQ(seen.size(), tree.segment_count());
  EXPECT_EQ(std::set<std::uint32_t>(seen.begin(), seen.end()).size(), tree.segment_count());
}

TEST(LimbChains, AStemIsOneLimbAndTwigsGrowFromIt) {
  const std::vector<LimbChain> limbs = limb_chains(stem_with_twigs(4, 6, 3));
  ASSERT_EQ(limbs.size(), 4u);
  EXPECT_EQ(limbs[0].radii.size(), 4u);
  EXPECT_EQ(limbs[0].parent, k_none);
  for (std::size_t l = 1; l < 4; ++l) {
    EXPECT_EQ(limbs[l].parent, 0u);
    EXPECT_EQ(limbs[l].radii.size(), 2u);
  }
}

TEST(LimbChains, AForkGoesOnWithTheThickerChild) {
  Tube tube = forked_tube();
  const Tree tree = tree_of(tube);
  const std::vector<LimbChain> limbs = limb_chains(tree);
  ASSERT_EQ(limbs.size(), 2u);
  EXPECT_EQ(limbs[0].radii.size(), 3u);
  EXPECT_LT(tree.hierarchy.radii[limbs[1].radii.back()].diameter,
            tree.hierarchy.radii[limbs[0].radii.back()].diameter);
}

TEST(LimbChains, NoHierarchyHasNoLimbs) {
  EXPECT_TRUE(limb_chains(Tree{}).empty());
  Tree still = stem_with_twigs(4, 6, 3);  // of a .tree, whose lines name points of their own
  still.hierarchy = {};
  EXPECT_TRUE(limb_chains(still).empty());
}

}  // namespace
}  // namespace copse
