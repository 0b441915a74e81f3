#include "lib/analysis/ecosystem/terrain_grid.h"

#include "lib/analysis/ecosystem/ground.h"

#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

TerrainPlan plan(std::uint32_t side) {
  return {.origin = {100, 5, -50}, .width = 30, .depth = 60, .columns = side, .rows = side};
}

TEST(TerrainGrid, WithoutAnythingItIsFlat) {
  const auto t = make_terrain(plan(4), Random(0));
  ASSERT_TRUE(t) << t.error().what;
  EXPECT_TRUE(t->regular());
  const TerrainGround ground(*t);
  EXPECT_EQ(ground.at(117, -31)->height, 5);
  EXPECT_EQ(ground.x1(), 130);
  EXPECT_EQ(ground.z1(), 10);
}

TEST(TerrainGrid, AHeightMapRunsFromLowToHigh) {
  const ValueMap map{2, 2, {0, 0, 1, 1}};
  TerrainPlan p = plan(33);
  p.height_map = &map;
  p.low = -2, p.high = 6;
  const auto t = make_terrain(p, Random(0));
  ASSERT_TRUE(t);
  const TerrainGround ground(*t);
  EXPECT_NEAR(ground.at(110, -50)->height, 5 - 2, 1e-6);
  EXPECT_NEAR(ground.at(110, -20)->height, 5 + 2, 1e-6);  // half way
  EXPECT_NEAR(ground.at(110, 10)->height, 5 + 6, 1e-6);
}

TEST(TerrainGrid, AFreeSurfaceIsSampledWithItsOwnXAndZ) {
  NurbsSurface s;  // a half cylinder along z: exact
  s.degree_u = 2, s.degree_v = 1, s.count_u = 5, s.count_v = 2;
  s.knots_u = {0, 0, 0, 1, 1, 2, 2, 2};
  s.knots_v = {0, 0, 1, 1};
  for (const double z : {0.0, 8.0})
    for (const Double3& p : {Double3{-3, 0, z}, {-3, 3, z}, {0, 3, z}, {3, 3, z}, {3, 0, z}})
      s.points.push_back(p);
  const double w = std::sqrt(0.5);
  s.weights = {1, w, 1, w, 1, 1, w, 1, w, 1};
  TerrainPlan p = plan(65);
  p.origin = {};
  p.surface = s;
  const auto t = make_terrain(p, Random(0));
  ASSERT_TRUE(t) << t.error().what;
  EXPECT_FALSE(t->regular());
  for (const Float3& v : t->points) EXPECT_NEAR(v.x * v.x + v.y * v.y, 9, 1e-5);
  EXPECT_NEAR(TerrainGround(*t).at(0, 4)->height, 3, 1e-3);
}

TEST(TerrainGrid, ASurfaceOfHeightsKeepsTheGridRegular) {
  NurbsSurface s;
  s.degree_u = s.degree_v = 2, s.count_u = s.count_v = 4;
  s.knots_u = s.knots_v = clamped_knots(4, 2);
  for (int i = 0; i < 16; ++i) s.points.push_back({0, i % 4 == 1 ? 8.0 : 0.0, 0});
  TerrainPlan p = plan(9);
  p.heights = s;
  const auto t = make_terrain(p, Random(0));
  ASSERT_TRUE(t);
  EXPECT_TRUE(t->regular());
  EXPECT_NEAR(t->heights[3], evaluate(s, 3 / 8.0, 0).y, 1e-6);
}

TEST(TerrainGrid, AVerticalTerrainIsRefusedInOneLine) {
  TerrainPlan p = plan(3);
  NurbsSurface s;
  s.degree_u = s.degree_v = 1, s.count_u = s.count_v = 2;
  s.knots_u = s.knots_v = clamped_knots(2, 1);
  s.points = {{0, 0, 0}, {0, 4, 0}, {0, 0, 9}, {0, 4, 9}};
  p.surface = s;
  const auto t = make_terrain(p, Random(0));
  ASSERT_FALSE(t);
  EXPECT_NE(t.error().what.find("has no area"), std::string::npos);
}

TEST(TerrainGrid, WhatIsNoTerrainIsRefused) {
  TerrainPlan p = plan(1);
  EXPECT_FALSE(make_terrain(p, Random(0)));
  p = plan(4);
  p.faults = {.count = 100, .first = 1e300, .last = 1e300};
  EXPECT_FALSE(make_terrain(p, Random(0)));
  p = plan(4);
  p.heights.emplace();
  const auto wrong = make_terrain(p, Random(0));
  ASSERT_FALSE(wrong);
  EXPECT_NE(wrong.error().what.find("terrain.nurbs"), std::string::npos);
}

}  // namespace
}  // namespace copse
