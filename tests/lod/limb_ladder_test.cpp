#include "lib/analysis/lod/limb_ladder.h"

#include "tests/lod/tube_tree.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

std::vector<LimbRung> ladder_of(const Tree& tree, RemovalOrder order = RemovalOrder::silhouette,
                                double share = 0) {
  const std::vector<Double3> centres = absolute_centres(tree);
  const PartTriangles trunk = trunk_triangles(tree);
  const std::vector<LimbChain> chains = limb_chains(tree);
  const LimbShape shape(tree, centres, trunk, chains.at(0));
  std::uint32_t full = 0;
  for (const std::uint32_t s : chains[0].segments)
    full +=
        static_cast<std::uint32_t>(tree.first_triangle_of_segment(s + 1) - tree.first_triangle_of_segment(s));
  return limb_ladder(shape, std::vector<std::uint8_t>(shape.ring_count()), full, 1.3, order, {}, share);
}

TEST(LimbLadder, EndsInNothingAndHasNoFloor) {
  const std::vector<LimbRung> ladder = ladder_of(stem_with_twigs(20, 8, 0));
  ASSERT_FALSE(ladder.empty());
  EXPECT_EQ(ladder.back().triangles, 0u);
  EXPECT_TRUE(ladder.back().kept.empty());
}

TEST(LimbLadder, TrianglesFallAndEachSavingCostsMoreThanTheOneBefore) {
  Tube tube;
  std::uint32_t before = k_none;
  for (int i = 0; i < 30; ++i)
    before = tube.add_ring({std::sin(i * 0.3), i * 0.5, std::cos(i * 0.2)}, 0.3 - 0.008 * i, 9, before);
  const std::vector<LimbRung> ladder = ladder_of(tree_of(tube));
  ASSERT_GT(ladder.size(), 5u);
  for (std::size_t i = 2; i < ladder.size(); ++i) {
    ASSERT_LT(ladder[i].triangles, ladder[i - 1].triangles);
    const double now =
        (ladder[i].cost - ladder[i - 1].cost) / (ladder[i - 1].triangles - ladder[i].triangles);
    const double then =
        (ladder[i - 1].cost - ladder[i - 2].cost) / (ladder[i - 2].triangles - ladder[i - 1].triangles);
    EXPECT_GE(now, then - 1e-12) << i;
  }
}

// What a polygon costs is how far it lies from the one of the mesh, not how much farther from a circle: a
// triangle saves a quarter of a square's sides and errs by all of its own.
TEST(LimbLadder, AWindingSquareStemNeverBecomesThreeSided) {
  Tube tube;
  std::uint32_t before = k_none;
  for (int i = 0; i < 33; ++i) before = tube.add_ring({0.2 * std::sin(i * 0.7), i * 0.5, 0}, 0.3, 4, before);
  const std::vector<LimbRung> ladder = ladder_of(tree_of(tube));
  ASSERT_GT(ladder.size(), 4u);
  for (const LimbRung& rung : ladder) EXPECT_NE(rung.sides, 3u) << rung.triangles;
}

TEST(LimbLadder, ARibbonIsDearerTheMoreOfTheTrunkItIs) {
  Tube tube;
  std::uint32_t before = k_none;
  for (int i = 0; i < 10; ++i) before = tube.add_ring({0, i * 0.5, 0}, 0.3, 8, before);
  const Tree tree = tree_of(tube);
  const auto ribbon_cost = [&](double share) {
    const std::vector<LimbRung> ladder = ladder_of(tree, RemovalOrder::silhouette, share);
    const auto at =
        std::find_if(ladder.begin(), ladder.end(), [](const LimbRung& r) { return r.sides == 2; });
    return at == ladder.end() ? 1e9 : at->cost;
  };
  EXPECT_LT(1.1 * ribbon_cost(0), ribbon_cost(0.1));
  EXPECT_LT(2 * ribbon_cost(0.1), ribbon_cost(0.9));
}

// A winding stem that tapers and has one sharp bend.
Tree winding() {
  Tube tube;
  std::uint32_t before = k_none;
  for (int i = 0; i < 24; ++i) {
    const double aside = i <= 15 ? 0 : 0.9 * (i - 15);
    before = tube.add_ring({aside + 0.1 * std::sin(i * 1.9), i * 0.5, 0.1 * std::cos(i * 2.3)},
                           0.4 - 0.015 * i, 12, before);
  }
  return tree_of(tube);
}

std::size_t with_inner_rings(const std::vector<LimbRung>& ladder) {
  return static_cast<std::size_t>(
      std::count_if(ladder.begin(), ladder.end(), [](const LimbRung& r) { return r.kept.size() > 2; }));
}

TEST(LimbLadder, ByAngleTheBendStaysLongest) {
  for (const RemovalOrder order : {RemovalOrder::angle, RemovalOrder::projected_angle}) {
    const std::vector<LimbRung> ladder = ladder_of(winding(), order);
    ASSERT_GT(with_inner_rings(ladder), 1u);
    for (const LimbRung& rung : ladder) {
      if (rung.kept.size() > 2) {
        EXPECT_TRUE(std::binary_search(rung.kept.begin(), rung.kept.end(), 15u));
      }
    }
  }
}

TEST(LimbLadder, ByDiameterTheThinnestRingsGoFirst) {
  const std::vector<LimbRung> ladder = ladder_of(winding(), RemovalOrder::diameter);
  ASSERT_GT(with_inner_rings(ladder), 1u);
  for (const LimbRung& rung : ladder) {
    for (std::size_t i = 0; i + 1 < rung.kept.size(); ++i) EXPECT_EQ(rung.kept[i], i);
  }
}

TEST(LimbLadder, AStraightStemLosesItsInnerRingsFirst) {
  const std::vector<LimbRung> ladder = ladder_of(stem_with_twigs(20, 8, 0));
  EXPECT_EQ(ladder.front().kept.size(), 2u);  // rings that cost nothing go at once
  EXPECT_EQ(ladder.front().sides, 8u);
}

}  // namespace
}  // namespace copse
