#include "lib/analysis/ecosystem/ground.h"

#include "lib/formats/random.h"
#include "tests/ecosystem/grounds.h"

#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

// The same terrain, its grid hidden from the fast path.
Terrain freed(const Terrain& t) {
  Terrain out = t;
  std::vector<Float3> points;
  for (std::uint32_t r = 0; r < t.rows; ++r)
    for (std::uint32_t c = 0; c < t.columns; ++c) points.push_back(to_float(t.vertex(c, r) - t.origin));
  out.points = std::move(points);
  out.heights = {};
  return out;
}

TEST(Ground, HeightsLieOnTheTrianglesAndAgreeWithTheGeneralLookUp) {
  Random random(3);
  const Terrain t = regular_terrain(17, 32, [&](double, double) { return random.uniform(-4, 4); });
  const Terrain f = freed(t);
  const TerrainGround fast(t), general(f);
  for (int i = 0; i < 20000; ++i) {
    const double x = random.uniform(0, 32), z = random.uniform(0, 32);
    const auto a = fast.at(x, z), b = general.at(x, z);
    ASSERT_TRUE(a && b);
    EXPECT_NEAR(a->height, b->height, 1e-10);
    EXPECT_LT(distance(a->normal, b->normal), 1e-10);
  }
}

TEST(Ground, VerticesAndEdgesAreOnTheTerrain) {
  const Terrain t = regular_terrain(5, 4, [](double x, double z) { return x * x + 3 * z; });
  const TerrainGround ground(t);
  for (std::uint32_t r = 0; r < 5; ++r)
    for (std::uint32_t c = 0; c < 5; ++c) EXPECT_EQ(ground.at(c, r)->height, t.vertex(c, r).y);
  EXPECT_NEAR(ground.at(0.5, 0)->height, 0.5, 1e-15);
  EXPECT_EQ(ground.at(-9, 99)->height, t.vertex(0, 4).y);  // outside: the border (hazard H29)
}

TEST(Ground, NormalsAreThoseOfThePlane) {
  const Terrain t = regular_terrain(9, 8, [](double x, double z) { return 0.5 * x - 0.25 * z; });
  const double l = std::sqrt(0.25 + 1 + 0.0625);
  EXPECT_LT(distance(TerrainGround(t).at(3.3, 4.4)->normal, Double3{-0.5 / l, 1 / l, 0.25 / l}), 1e-12);
}

TEST(Ground, OfAFoldTheHighestTriangleCounts) {
  // A sheet that runs out along x, back above itself and out again.
  std::vector<Float3> p;
  for (const float z : {0.0f, 2.0f})
    for (const Float3& v : {Float3{0, 0, z}, {4, 1, z}, {1, 3, z}, {6, 5, z}}) p.push_back(v);
  const Terrain t = free_terrain(4, 2, p);
  const TerrainGround ground(t);
  EXPECT_NEAR(ground.at(2, 1)->height, 3 + 2.0 / 5, 1e-6);
  EXPECT_NEAR(ground.at(0.5, 1)->height, 0.125, 1e-6);
}

TEST(Ground, AOneTriangleTerrainHasGroundUnderTheTriangleOnly) {
  const Terrain t = free_terrain(2, 2, {{0, 0, 0}, {0, 0, 0}, {0, 2, 4}, {4, 2, 4}});
  const TerrainGround ground(t);
  EXPECT_NEAR(ground.area(), 8, 1e-12);
  EXPECT_FALSE(ground.covers_all());
  EXPECT_TRUE(ground.at(1, 3));
  EXPECT_FALSE(ground.at(3, 1));
  EXPECT_FALSE(ground.at(50, 1));
}

TEST(Ground, AVerticalTerrainHasNoArea) {
  const Terrain t = free_terrain(2, 2, {{0, 0, 0}, {0, 9, 0}, {0, 0, 5}, {0, 9, 5}});
  EXPECT_EQ(TerrainGround(t).area(), 0);
  EXPECT_FALSE(TerrainGround(t).at(0, 2));
  EXPECT_FALSE(TerrainGround(Terrain{}).at(0, 0));
}

TEST(Ground, FarFromTheOriginNothingIsLost) {
  Terrain t = regular_terrain(3, 2, [](double x, double) { return x; });
  t.origin = {1e7, 100, -1e7};
  EXPECT_NEAR(TerrainGround(t).at(1e7 + 0.3125, -1e7 + 1)->height, 100.3125, 1e-8);
}

// A square on its corner, 500 m up, half of its box empty; it rises along +X.
Terrain diamond() {
  Terrain t = free_terrain(2, 2, {{0, 5, 10}, {10, 10, 0}, {10, 15, 20}, {20, 20, 10}});
  t.origin = {0, 500, 0};
  return t;
}

TEST(Ground, AFreeSurfaceDoesNotCoverTheCornersOfItsBox) {
  const Terrain t = diamond();
  const TerrainGround ground(t);
  EXPECT_TRUE(ground.covers(10, 10));
  EXPECT_TRUE(ground.covers(0, 10));
  EXPECT_FALSE(ground.covers(0.5, 0.5));
  EXPECT_FALSE(ground.covers(30, 30));
  EXPECT_FALSE(ground.covers(std::nan(""), 10));
  const Terrain r = regular_terrain(5, 4, [](double x, double) { return x; });
  EXPECT_TRUE(TerrainGround(r).covers(4, 0));
  EXPECT_FALSE(TerrainGround(r).covers(4.01, 0));  // though at() has a height for it
}

TEST(Ground, BesideAFreeSurfaceItIsThatOfTheNearestVertex) {
  const Terrain t = diamond();
  const TerrainGround ground(t);
  GroundBeside all(t, ground);
  const struct {
    double x, z, height;
  } cases[] = {{0.5, 4, 505}, {4, 0.5, 510}, {-1e6, 10, 505}, {30, 12, 520}, {12, 30, 515}};
  for (const auto& c : cases) EXPECT_NEAR(all.at(c.x, c.z).height, c.height, 1e-9) << c.x << ", " << c.z;
  EXPECT_EQ(all.at(9, 11).height, ground.at(9, 11)->height);  // on it nothing changes
  EXPECT_LT(distance(all.at(-5, 10).normal, ground.at(0, 10)->normal), 1e-12);
}

TEST(Ground, BesideAWallTheVertexIsAllThereIs) {
  const Terrain t = free_terrain(2, 2, {{0, 3, 0}, {5, 3, 0}, {0, 9, 0}, {5, 9, 0}});
  const TerrainGround ground(t);
  EXPECT_EQ(GroundBeside(t, ground).at(-1, 1).height, 3);
}

// Layers of a nearly upright surface, a millimetre thick: each place has many triangles below it.
TEST(Ground, ManyLayersAreLookedThroughInAFewBuckets) {
  constexpr std::uint32_t k_side = 400;
  Terrain t;
  t.columns = t.rows = k_side;
  std::vector<Float3> points;
  Random random(4);
  for (std::uint32_t r = 0; r < k_side; ++r)
    for (std::uint32_t c = 0; c < k_side; ++c)
      points.push_back(
          {static_cast<float>(random.uniform(0, 1e-3)), static_cast<float>(c), static_cast<float>(r)});
  t.points = points;
  const TerrainGround ground(t);
  for (int n = 0; n < 20; ++n) {
    const double x = random.uniform(3e-4, 7e-4), z = random.uniform(1, k_side - 2);
    const auto here = ground.at(x, z);
    ASSERT_TRUE(here);
    EXPECT_GT(here->height, k_side - 20.0);  // nearly the topmost layer has it
  }
}

}  // namespace
}  // namespace copse
