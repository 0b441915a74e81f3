#include "lib/formats/ecosystem/terrain_normal.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace copse {
namespace {

template <class Height>
Terrain terrain_of(std::uint32_t side, double spacing, const Height& height) {
  Terrain t;
  t.columns = t.rows = side;
  t.origin = {100, 5, -70};
  t.spacing_x = t.spacing_z = spacing;
  std::vector<float> heights;
  for (std::uint32_t r = 0; r < side; ++r)
    for (std::uint32_t c = 0; c < side; ++c)
      heights.push_back(static_cast<float>(height(c * spacing, r * spacing)));
  t.heights = std::move(heights);
  return t;
}

TEST(TerrainNormal, OfAPlaneIsThePlanesAtEveryVertex) {
  const Terrain t = terrain_of(5, 2, [](double x, double z) { return 0.5 * x - 0.25 * z; });
  const Double3 wanted = normalized(Double3{-0.5, 1, 0.25});
  for (std::uint32_t r = 0; r < 5; ++r)
    for (std::uint32_t c = 0; c < 5; ++c) EXPECT_LT(distance(terrain_normal(t, c, r), wanted), 1e-6);
}

TEST(TerrainNormal, FollowsABowlWithinItsGrid) {
  const Terrain t =
      terrain_of(41, 0.25, [](double x, double z) { return 0.1 * ((x - 5) * (x - 5) + (z - 5) * (z - 5)); });
  for (std::uint32_t r = 1; r < 40; ++r)
    for (std::uint32_t c = 1; c < 40; ++c) {
      const Double3 wanted = normalized(Double3{-0.2 * (c * 0.25 - 5), 1, -0.2 * (r * 0.25 - 5)});
      EXPECT_LT(distance(terrain_normal(t, c, r), wanted), 0.01) << c << ' ' << r;
    }
}

TEST(TerrainNormal, PointsUpHoweverAFreeSurfaceIsTurned) {
  Terrain t;
  t.columns = t.rows = 2;
  t.points = std::vector<Float3>{{1, 0, 0}, {0, 0, 0}, {1, 1, 1}, {0, 1, 1}};  // mirrored
  EXPECT_LT(distance(terrain_normal(t, 0, 0), normalized(Double3{0, 1, -1})), 1e-12);
  t.points = std::vector<Float3>(4);
  EXPECT_EQ(terrain_normal(t, 1, 1), (Double3{0, 1, 0}));
}

}  // namespace
}  // namespace copse
