#include "lib/analysis/lod/crown_field.h"

#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

// n^3 squares of side s in a cube of side 1, facing +X, +Y and +Z in turn.
std::vector<FoliageTriangle> filled_cube(int n, double s) {
  std::vector<FoliageTriangle> out;
  for (int i = 0; i < n * n * n; ++i) {
    const Double3 c{(i % n + 0.5) / n, (i / n % n + 0.5) / n, (i / n / n + 0.5) / n};
    const int k = i % 3;
    Double3 u{}, v{};
    u[(k + 1) % 3] = s / 2, v[(k + 2) % 3] = s / 2;
    out.push_back({{c - u - v, c + u - v, c + u + v}, 1});
    out.push_back({{c - u - v, c + u + v, c - u + v}, 1});
  }
  return out;
}

TEST(CrownField, SeesTheRimOfADenseCrownAndNotItsMiddle) {
  const CrownField field(filled_cube(16, 0.1), 16);
  EXPECT_LT(field.exposure({0.5, 0.5, 0.5}), 0.01);
  EXPECT_GT(field.exposure({0.5, 0.5, 0.99}), 0.15);
  EXPECT_GT(field.exposure({0.99, 0.99, 0.99}), field.exposure({0.5, 0.5, 0.99}));
  EXPECT_EQ(field.exposure({2, 0.5, 0.5}), 1);
}

TEST(CrownField, SeesThroughASparseCrown) {
  const CrownField field(filled_cube(8, 0.005), 16);
  EXPECT_GT(field.exposure({0.5, 0.5, 0.5}), 0.95);
  EXPECT_GT(field.at({0.5, 0.5, 0.5}).openness, 0.95);
}

TEST(CrownField, FollowsBeerAndLambertThroughASlab) {
  // Sixteen sheets, each with a tenth of its area in leaves: 1.6 in all. Along X a line meets optical depth
  // 0.8.
  std::vector<FoliageTriangle> slab;
  for (FoliageTriangle& t : filled_cube(16, std::sqrt(0.1) / 16)) slab.push_back(t);
  const CrownField field(slab, 16);
  const double through = field.at({0.5, 0.5, 0.5}).openness;
  EXPECT_GT(through, 0.3);
  EXPECT_LT(through, std::exp(-0.8) + 0.01);
}

TEST(CrownField, CountsOnlyTheOpaqueShare) {
  auto half = filled_cube(8, 0.1);
  for (FoliageTriangle& t : half) t.opacity = 0.5;
  EXPECT_GT(CrownField(half, 16).exposure({0.5, 0.5, 0.5}),
            CrownField(filled_cube(8, 0.1), 16).exposure({0.5, 0.5, 0.5}));
}

TEST(CrownField, MeasuresHowFarTheFoliageIs) {
  std::vector<FoliageTriangle> two;
  two.push_back({{{{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}}}, 1});
  two.push_back({{{{10, 0, 0}, {10, 0.1, 0}, {9.9, 0, 0}}}, 1});
  const CrownField field(two, 100);
  EXPECT_EQ(field.at({0.05, 0.05, 0}).emptiness, 0);
  EXPECT_NEAR(field.at({5, 0, 0}).emptiness, 4.9, 0.2);
  EXPECT_NEAR(field.at({0, 7, 0}).emptiness, 6.9, 0.3);
  EXPECT_EQ(field.at({0, 7, 0}).openness, 1);
}

TEST(CrownField, KnowsTheHullOfItsFoliage) {
  const CrownField field(filled_cube(8, 0.1), 8);
  const std::vector<Double3> outside{{1.5, 0.5, 0.5}};
  EXPECT_NEAR(field.hull().way_back(outside, 0).x, -0.5, 0.08);
  EXPECT_NEAR(field.hull().width(), std::sqrt(3.0), 0.15);
}

TEST(CrownField, OfNothingOrOfOnePlaceIsDefined) {
  const CrownField none({}, 8);
  EXPECT_EQ(none.cross_section(), 0);
  EXPECT_LT(none.hull().width(), 0);
  const std::vector<FoliageTriangle> point{{{{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}}, 1}};
  const CrownField one(point, 8);
  EXPECT_GT(one.exposure({1, 1, 1}), 0);
  EXPECT_EQ(one.at({1, 1, 1}).emptiness, 0);
}

}  // namespace
}  // namespace copse
