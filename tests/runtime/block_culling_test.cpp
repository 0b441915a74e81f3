#include "lib/runtime/block_culling.h"

#include "lib/analysis/ecosystem/block_trees.h"
#include "lib/formats/random.h"
#include "tests/formats/ecosystem_maker.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace copse {
namespace {

constexpr BlockHierarchy k_all[] = {BlockHierarchy::flat, BlockHierarchy::boxes, BlockHierarchy::kd_tree,
                                    BlockHierarchy::rtree, BlockHierarchy::coherent};

Ecosystem with_trees(bool exact) {
  Ecosystem eco = little_ecosystem(exact);
  eco.kd_tree = block_kd_tree(eco);
  eco.rtree = block_rtree(eco);
  return eco;
}

std::vector<SeenBlock> seen(const Ecosystem& eco, const Camera& camera, BlockHierarchy by,
                            CullCounts* counts = nullptr) {
  std::vector<SeenBlock> visible;
  visible_blocks(eco, by, frustum_of(make_view(camera, 1.5, 0.1, 1000)), camera.eye, visible, counts);
  std::sort(visible.begin(), visible.end(),
            [](const SeenBlock& a, const SeenBlock& b) { return a.block < b.block; });
  return visible;
}

const Camera k_above{.eye = {10, 200, 10.01}, .target = {10, 0, 10}, .up = {0, 0, -1}, .fov = 1};

TEST(BlockCulling, EveryHierarchySeesWhatTestingEveryBlockSees) {
  const Ecosystem eco = with_trees(false);
  Random random(1);
  std::size_t some = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto point = [&] {
      return Double3{random.uniform(-10, 30), random.uniform(0, 10), random.uniform(-10, 30)};
    };
    const Camera camera{.eye = point(), .target = point(), .up = {0, 1, 0}, .fov = random.uniform(0.1, 1)};
    const Frustum frustum = frustum_of(make_view(camera, 1.5, 0.1, 1000));
    std::vector<SeenBlock> judged;
    for (std::uint32_t b = 0; b < eco.blocks.size(); ++b) {
      const FloatBox& box = eco.blocks[b].bounds;
      const Visibility v =
          classify(frustum, camera.eye, {eco.origin + to_double(box.min), eco.origin + to_double(box.max)});
      if (v != Visibility::outside) judged.push_back({b, v == Visibility::inside});
    }
    for (const BlockHierarchy by : k_all) EXPECT_EQ(seen(eco, camera, by), judged) << static_cast<int>(by);
    some += !judged.empty() && judged.size() < eco.blocks.size();
  }
  EXPECT_GT(some, 150u);
}

// A camera that turns and walks a little from frame to frame, and jumps now and then.
TEST(BlockCulling, WhatIsKnownOfTheFrameBeforeSavesTestsAndChangesNothing) {
  const Ecosystem eco = with_trees(false);
  Random random(2);
  CullMemory memory;
  std::uint64_t with = 0, without = 0, some = 0;
  Double3 eye, target;
  for (int i = 0; i < 2000; ++i) {
    if (i % 100 == 0) {
      eye = {random.uniform(-10, 30), random.uniform(0, 10), random.uniform(-10, 30)};
      target = {random.uniform(-10, 30), random.uniform(0, 10), random.uniform(-10, 30)};
    }
    eye += {random.uniform(-0.1, 0.1), 0, random.uniform(-0.1, 0.1)};
    target += {random.uniform(-0.3, 0.3), 0, random.uniform(-0.3, 0.3)};
    const Frustum frustum = frustum_of(make_view({.eye = eye, .target = target, .fov = 0.4}, 1.5, 0.1, 1000));
    std::vector<SeenBlock> expected, got;
    CullCounts plain, coherent;
    visible_blocks(eco, BlockHierarchy::boxes, frustum, eye, expected, &plain);
    visible_blocks(eco, BlockHierarchy::coherent, frustum, eye, got, &coherent, &memory);
    ASSERT_EQ(got, expected) << i;
    ASSERT_EQ(coherent.nodes_visited, plain.nodes_visited);
    with += coherent.plane_tests, without += plain.plane_tests;
    some += !expected.empty() && expected.size() < eco.blocks.size();
  }
  EXPECT_GT(some, 300u);
  EXPECT_LT(with, 0.7 * static_cast<double>(without));
}

TEST(BlockCulling, BelowANodeThatIsInsideNothingIsTested) {
  const Ecosystem eco = with_trees(false);
  for (const BlockHierarchy by :
       {BlockHierarchy::boxes, BlockHierarchy::coherent, BlockHierarchy::kd_tree, BlockHierarchy::rtree}) {
    CullCounts counts;
    const auto blocks = seen(eco, k_above, by, &counts);
    EXPECT_EQ(blocks.size(), 8u);
    EXPECT_TRUE(std::all_of(blocks.begin(), blocks.end(), [](const SeenBlock& b) { return b.whole; }));
    EXPECT_EQ(counts.nodes_visited, 1u);
    EXPECT_EQ(counts.blocks_tested, 0u);
    EXPECT_EQ(counts.plane_tests, 6u);
  }
}

TEST(BlockCulling, WithoutCullingEverythingIsSeenAndNothingTested) {
  CullCounts counts;
  const Camera away{.eye = {10, 5, 40}, .target = {10, 5, 90}};
  EXPECT_EQ(seen(little_ecosystem(false), away, BlockHierarchy::none, &counts).size(), 8u);
  EXPECT_EQ(counts.plane_tests, 0u);
  EXPECT_TRUE(seen(little_ecosystem(false), away, BlockHierarchy::flat).empty());
}

TEST(BlockCulling, AViewRangeEndsWhatIsSeen) {
  Ecosystem eco = with_trees(true);
  for (const BlockHierarchy by : k_all) {
    eco.types[1].view_range = 100;
    EXPECT_EQ(seen(eco, k_above, by).size(), 4u);
    eco.types[1].view_range = 300;
    EXPECT_EQ(seen(eco, k_above, by).size(), 8u);
  }
}

TEST(BlockCulling, OfNothingNothingIsSeen) {
  for (const BlockHierarchy by : k_all) EXPECT_TRUE(seen(Ecosystem{}, Camera{}, by).empty());
  Ecosystem eco = little_ecosystem(false);
  std::vector<QuadNode> nodes(5);  // all invalid
  eco.boxes = nodes;
  EXPECT_TRUE(seen(eco, Camera{.eye = {10, 5, 40}, .target = {10, 0, 10}}, BlockHierarchy::boxes).empty());
}

TEST(BlockCulling, AHierarchyIsThereWhenItsFileHasIt) {
  const Ecosystem bare = little_ecosystem(false), rich = with_trees(false);
  for (const BlockHierarchy by : {BlockHierarchy::kd_tree, BlockHierarchy::rtree}) {
    EXPECT_FALSE(has_hierarchy(bare, by));
    EXPECT_TRUE(has_hierarchy(rich, by));
    EXPECT_TRUE(has_hierarchy(Ecosystem{}, by));
  }
  EXPECT_TRUE(has_hierarchy(bare, BlockHierarchy::boxes));
}

TEST(BlockCulling, TheDistanceToABoxIsThatToItsNearestPoint) {
  const DoubleBox box{{0, 0, 0}, {2, 2, 2}};
  EXPECT_EQ(distance_to({1, 1, 1}, box), 0);
  EXPECT_EQ(distance_to({5, 6, 2}, box), 5);
}

}  // namespace
}  // namespace copse
