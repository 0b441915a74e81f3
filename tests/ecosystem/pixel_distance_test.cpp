#include "lib/analysis/ecosystem/pixel_distance.h"

#include "lib/formats/random.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

const PlantedArea k_area{-3, 10, 43, 61};  // 23 x 17 pixels of 2 x 3 m

ValueMap random_map(Random& random, double share) {
  ValueMap map{23, 17, std::vector<float>(23 * 17)};
  for (float& v : map.values) v = random.chance(share) ? 1.0f : 0.0f;
  map.values[40] = 0.5f;
  return map;
}

// To the nearest point of every marked pixel.
double by_force(const ValueMap& map, double x, double z) {
  double best = 1e300;
  for (std::uint32_t r = 0; r < map.height; ++r)
    for (std::uint32_t c = 0; c < map.width; ++c) {
      if (map.values[r * map.width + c] < 0.5f) continue;
      const double x0 = k_area.x0 + 2.0 * c, z0 = k_area.z0 + 3.0 * r;
      const double dx = std::max({x0 - x, x - x0 - 2, 0.0}), dz = std::max({z0 - z, z - z0 - 3, 0.0});
      best = std::min(best, std::sqrt(dx * dx + dz * dz));
    }
  return best;
}

TEST(PixelDistance, IsExactFromAnyPointToThePixelsAreaEvenWhenPixelsAreNotSquare) {
  Random random(8);
  for (const double share : {0.0, 0.003, 0.02, 0.3}) {
    const ValueMap map = random_map(random, share);
    const PixelDistance distance(map, k_area);
    for (int i = 0; i < 3000; ++i) {
      const double x = random.uniform(k_area.x0, k_area.x1), z = random.uniform(k_area.z0, k_area.z1);
      EXPECT_NEAR(distance.at(x, z), by_force(map, x, z), 1e-12) << x << ' ' << z;
    }
  }
}

// The quick answer and the exact one are one answer.
TEST(PixelDistance, LimitsAreThoseOfTheExactDistance) {
  Random random(9);
  const ValueMap map = random_map(random, 0.01);
  const PixelDistance distance(map, k_area);
  int inside = 0;
  for (int i = 0; i < 20000; ++i) {
    const double x = random.uniform(k_area.x0, k_area.x1), z = random.uniform(k_area.z0, k_area.z1);
    const double d = distance.at(x, z), least = random.uniform(0, 12), most = least + random.uniform(0, 8);
    EXPECT_EQ(distance.is_within(x, z, least, most), d >= least && d <= most);
    inside += d >= least && d <= most;
  }
  EXPECT_GT(inside, 1000);
}

TEST(PixelDistance, OnAMarkedPixelItIsZeroAndOutsideTheAreaThatOfTheBorder) {
  ValueMap map{4, 4, std::vector<float>(16)};
  map.values[5] = 1;
  const PixelDistance distance(map, {0, 0, 4, 4});
  EXPECT_EQ(distance.at(1, 1), 0);
  EXPECT_EQ(distance.at(1.9, 1.2), 0);
  EXPECT_EQ(distance.at(2, 2), 0);
  EXPECT_DOUBLE_EQ(distance.at(3, 3), std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(distance.at(-100, 1.5), 1);
  EXPECT_DOUBLE_EQ(distance.at(100, 1.5), 2);
}

TEST(PixelDistance, OfNothingItIsInfinite) {
  const double infinite = std::numeric_limits<double>::infinity();
  const ValueMap map{3, 3, std::vector<float>(9)};
  for (const PixelDistance& distance : {PixelDistance(), PixelDistance(map, k_area)}) {
    EXPECT_EQ(distance.at(1, 20), infinite);
    EXPECT_FALSE(distance.is_within(1, 20, 5, 100));
    EXPECT_TRUE(distance.is_within(1, 20, 5, infinite));
  }
}

}  // namespace
}  // namespace copse
