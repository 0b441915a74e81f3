#include "lib/analysis/ecosystem/density_field.h"

#include "tests/ecosystem/grounds.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

const PlantedArea k_area{0, 0, 64, 64};

struct World {
  Terrain terrain = regular_terrain(
      65, 64, [](double x, double) { return x < 32 ? 0 : x - 32; });  // 45 degrees in the east
  TerrainGround ground{terrain};
  DensityField field(const PlacementRules& rules, std::uint32_t side = 64) const {
    return make_field(PlacementTest(rules, k_area, ground), side, side, Random(1));
  }
};

TEST(DensityField, WithoutRulesEveryCellIsAsLikely) {
  EXPECT_FALSE(PlacementRules{}.limits_anything());
  const DensityField f = World().field({});
  EXPECT_EQ(f.total(), 64 * 64);
}

TEST(DensityField, SlopeAndAltitudeAreSharp) {
  const World world;
  PlacementRules steep;
  steep.slope = {0, 30};
  EXPECT_EQ(world.field(steep).total(), 32 * 64);
  steep.slope = {44, 46};
  EXPECT_EQ(world.field(steep).total(), 32 * 64);
  PlacementRules high;
  high.altitude = {16, 100};
  EXPECT_EQ(world.field(high).total(), 16 * 64);
  EXPECT_TRUE(high.limits_anything());
}

TEST(DensityField, ForbiddenPixelsAndDensitiesWeigh) {
  const World world;
  const ValueMap forbidden{2, 1, {0, 1}}, density{1, 2, {3, 1}};
  PlacementRules rules;
  rules.forbidden = &forbidden;
  rules.density = &density;
  EXPECT_EQ(world.field(rules).total(), 32 * (32 * 3 + 32 * 1));
}

TEST(DensityField, SharesOfAMixAddUpToTheDensity) {
  const World world;
  const ValueMap density{1, 1, {2}}, oak{2, 1, {0.25f, 0}}, pine{2, 1, {0.75f, 0.5f}}, none{1, 1, {0}};
  PlacementRules a, b;
  a.density = b.density = &density;
  a.share_total = b.share_total = {&oak, &pine};
  a.share_of = &oak;
  b.share_of = &pine;
  const double total = world.field({.density = &density}).total();
  EXPECT_DOUBLE_EQ(world.field(a).total(), total / 8);
  EXPECT_DOUBLE_EQ(world.field(a).total() + world.field(b).total(), total);
  a.share_total = {&none};
  EXPECT_EQ(world.field(a).total(), 0);  // a mix of nothing is nothing
}

TEST(DensityField, ClustersReachNoFartherThanTheirRadius) {
  const World world;
  PlacementRules rules;
  rules.clusters = {.count = 1, .radius = 10};
  const DensityField f = world.field(rules, 128);
  double cells = 0;
  for (const double w : f.weights) cells += w > 0;
  EXPECT_LE(cells / 4, 3.1416 * 100 * 1.05);
  EXPECT_GT(f.total(), 0);
}

TEST(DensityField, DistanceToNothingIsInfinite) {
  const ValueMap map{3, 3, std::vector<float>(9)};
  const World world;
  PlacementRules rules;
  rules.distance_to = &map;
  rules.distance = {5, 100};
  EXPECT_EQ(world.field(rules).total(), 0);
  rules.distance = {5};  // at least 5 m from what is not there
  EXPECT_EQ(world.field(rules).total(), 64 * 64);
}

TEST(DensityField, NothingStandsWhereThereIsNoGround) {
  const Terrain half = free_terrain(2, 2, {{0, 0, 0}, {0, 0, 0}, {0, 0, 64}, {64, 0, 64}});
  const TerrainGround ground(half);
  const DensityField f = make_field(PlacementTest(PlacementRules{}, k_area, ground), 64, 64, Random(1));
  EXPECT_NEAR(f.total(), 64 * 64 / 2.0, 33);
}

TEST(DensityField, TheGridFollowsMapsCountsAndClustersUpToALimit) {
  const auto side = [](std::uint32_t map, std::uint64_t instances, Clusters clusters = {}) {
    return field_side(map, instances, clusters, k_area);
  };
  EXPECT_EQ(side(0, 1), 64u);
  EXPECT_EQ(side(500, 1), 1000u);
  EXPECT_EQ(side(0, 250000), 500u);
  EXPECT_EQ(side(4096, 1), k_most_field_cells);
  EXPECT_EQ(side(1366, 1), 1366u);  // whole multiples and parts of the map
  EXPECT_EQ(side(1500, 1), 1500u);
  EXPECT_EQ(side(10, 1), 70u);
  EXPECT_EQ(side(6000, 1), 2000u);
  EXPECT_EQ(side(4099, 1), k_most_field_cells);              // a prime
  EXPECT_EQ(side(0, 1, {.count = 3, .radius = 0.5}), 512u);  // of 64 m
  EXPECT_EQ(side(0, 1, {.count = 3, .radius = 1e-6}), k_most_field_cells);
}

// A stripe of one pixel every so many, in a map that no grid fits.
TEST(DensityField, EveryPixelOfALargeMapCounts) {
  const World world;
  for (const std::uint32_t w : {1366u, 3001u, 4096u}) {
    ValueMap map{w, 1, std::vector<float>(w)};
    for (std::uint32_t i = 0; i < w; i += 3) map.values[i] = 1;
    const std::uint32_t side = field_side(w, 1, {}, k_area);
    EXPECT_NEAR(world.field({.density = &map}, side).total() / side / side, 1 / 3.0, 0.003) << w;
  }
}

TEST(DensityField, ARuleThinnerThanACellHasItsShare) {
  PlacementRules band;
  band.altitude = {16.1, 16.25};
  EXPECT_NEAR(World().field(band).total(), 64 * 0.15, 0.2);
}

// Not by the pixels that places lie in: the border of what is allowed runs where the distance does.
TEST(DensityField, DistancesAreSharpBetweenPixels) {
  ValueMap map{8, 8, std::vector<float>(64)};
  for (std::size_t i = 0; i < 64; i += 8) map.values[i] = 1;  // x from 0 to 8
  const World world;
  PlacementRules rules;
  rules.distance_to = &map;
  rules.distance = {2.5, 11.3};
  const PlacementTest test(rules, k_area, world.ground);
  for (const double x : {10.51, 13.0, 19.29}) EXPECT_TRUE(test.weight(x, 30) > 0) << x;
  for (const double x : {4.0, 10.49, 19.31, 60.0}) EXPECT_FALSE(test.weight(x, 30) > 0) << x;
  EXPECT_NEAR(world.field(rules, 640).total() / 100, 64 * 8.8, 64 * 0.06);
}

TEST(DensityField, TenThousandWideClustersTakeLittleTime) {
  PlacementRules rules;
  rules.clusters = {.count = 10000, .radius = 1000};
  EXPECT_NEAR(World().field(rules, 512).total() / 512 / 512, 1, 1e-3);
}

TEST(DensityField, ClustersSmallerThanACellAreNotLost) {
  PlacementRules rules;
  rules.clusters = {.count = 40, .radius = 1e-3};
  const DensityField f = World().field(rules);
  const auto cells = std::count_if(f.weights.begin(), f.weights.end(), [](double w) { return w > 0; });
  EXPECT_GE(cells, 30);  // two may share a cell
  EXPECT_LE(cells, 3 * 40);
}

}  // namespace
}  // namespace copse
