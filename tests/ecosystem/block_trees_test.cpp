#include "lib/analysis/ecosystem/block_trees.h"

#include "lib/formats/ecosystem/ecosystem_file.h"
#include "lib/formats/random.h"
#include "tests/formats/ecosystem_maker.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(BlockTrees, BothHoldEveryBlockOnceAndAreSound) {
  Ecosystem eco = little_ecosystem(false);
  eco.kd_tree = block_kd_tree(eco);
  eco.rtree = block_rtree(eco);
  EXPECT_EQ(check_ecosystem(eco), std::vector<std::string>{});
  for (const auto& nodes : {eco.kd_tree, eco.rtree}) {
    std::vector<std::uint32_t> blocks;
    for (const BlockNode& n : nodes)
      if (n.block != k_none) blocks.push_back(n.block);
    std::sort(blocks.begin(), blocks.end());
    ASSERT_EQ(blocks.size(), 8u);
    for (std::uint32_t b = 0; b < 8; ++b) EXPECT_EQ(blocks[b], b);
  }
}

TEST(BlockTrees, ALoopWithoutAStackFindsWhatTestingEveryBlockFinds) {
  const Ecosystem eco = little_ecosystem(true);
  Random random(1);
  for (const auto& nodes : {block_kd_tree(eco), block_rtree(eco)})
    for (int i = 0; i < 500; ++i) {
      const float x = static_cast<float>(random.uniform(-12, 12)),
                  z = static_cast<float>(random.uniform(-12, 12));
      const auto holds = [&](const FloatBox& b) {
        return b.min.x <= x && x <= b.max.x && b.min.z <= z && z <= b.max.z;
      };
      std::vector<std::uint32_t> found, flat;
      for (std::uint32_t n = 0; n < nodes.size();) {
        if (!holds(nodes[n].bounds)) {
          n = nodes[n].skip;
          continue;
        }
        if (nodes[n].block != k_none) found.push_back(nodes[n].block);
        ++n;
      }
      for (std::uint32_t b = 0; b < eco.blocks.size(); ++b)
        if (holds(eco.blocks[b].bounds)) flat.push_back(b);
      std::sort(found.begin(), found.end());
      EXPECT_EQ(found, flat);
    }
}

TEST(BlockTrees, OfNothingThereIsNone) {
  EXPECT_TRUE(block_kd_tree(Ecosystem{}).empty());
  EXPECT_TRUE(block_rtree(Ecosystem{}).empty());
}

TEST(BlockTrees, NodesThatDoNotHoldTheirBlocksAreFound) {
  Ecosystem eco = little_ecosystem(false);
  std::vector<BlockNode> nodes = block_kd_tree(eco);
  nodes[0].bounds.max.x = nodes[0].bounds.min.x;
  eco.kd_tree = nodes;
  ASSERT_FALSE(check_ecosystem(eco).empty());
  EXPECT_NE(check_ecosystem(eco).front().find("EKDT[0]"), std::string::npos);
  nodes = block_kd_tree(eco);
  nodes[0].skip = 1;
  eco.kd_tree = nodes;
  EXPECT_FALSE(check_ecosystem(eco).empty());
}

}  // namespace
}  // namespace copse
