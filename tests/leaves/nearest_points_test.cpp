#include "lib/analysis/leaves/nearest_points.h"

#include "lib/formats/material.h"
#include "lib/formats/random.h"

#include <vector>

#include <gtest/gtest.h>

namespace copse {
namespace {

std::uint32_t by_brute_force(const std::vector<Double3>& points, const Double3& p,
                             const std::vector<std::uint8_t>& skip) {
  std::uint32_t best = k_none;
  double least = 0;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Double3 d = p - points[i];
    if (!skip[i] && (best == k_none || dot(d, d) < least)) best = i, least = dot(d, d);
  }
  return best;
}

TEST(NearestPoints, OfNoneIsNone) {
  EXPECT_EQ(NearestPoints({}).nearest({1, 2, 3}), k_none);
}

TEST(NearestPoints, OfEqualsTheLowestWins) {
  const std::vector<Double3> points{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {1, 0, 0}};
  EXPECT_EQ(NearestPoints(points).nearest({0, 0, 0}), 0u);
  EXPECT_EQ(NearestPoints(points).nearest({-0.1, 0.1, 0}), 1u);
  std::vector<Double3> same(500, Double3{3, 3, 3});
  EXPECT_EQ(NearestPoints(same).nearest({0, 0, 0}), 0u);
}

TEST(NearestPoints, SkipsWhatItIsToldTo) {
  const std::vector<Double3> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  EXPECT_EQ(NearestPoints(points).nearest({0, 0, 0}, std::vector<std::uint8_t>{1, 0, 0}), 1u);
  EXPECT_EQ(NearestPoints(points).nearest({0, 0, 0}, std::vector<std::uint8_t>{1, 1, 1}), k_none);
}

TEST(NearestPoints, AgreesWithBruteForceOnGridsFullOfTies) {
  Random random(1);
  for (const double scale : {1.0, 1e-20, 1e20}) {
    std::vector<Double3> points;
    std::vector<std::uint8_t> skip;
    for (int i = 0; i < 700; ++i) {
      points.push_back(Double3{double(random.below(8)), double(random.below(8)), double(random.below(3))} *
                       scale);
      skip.push_back(random.chance(0.2));
    }
    const NearestPoints tree(points);
    for (int i = 0; i < 500; ++i) {
      const Double3 p =
          Double3{random.below(16) / 2.0, random.below(16) / 2.0, random.below(6) / 2.0} * scale;
      ASSERT_EQ(tree.nearest(p, skip), by_brute_force(points, p, skip));
    }
  }
}

}  // namespace
}  // namespace copse
