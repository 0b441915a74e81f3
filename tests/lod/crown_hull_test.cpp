#include "lib/analysis/lod/crown_hull.h"

#include "lib/formats/random.h"

#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

// The corners of a box and points within it.
std::vector<Double3> box_of_points(const Double3& size) {
  std::vector<Double3> out;
  Random random(5);
  for (int i = 0; i < 8; ++i) out.push_back({i % 2 * size.x, i / 2 % 2 * size.y, i / 4 * size.z});
  for (int i = 0; i < 500; ++i)
    out.push_back({random.uniform() * size.x, random.uniform() * size.y, random.uniform() * size.z});
  return out;
}

std::vector<Double3> triangle_about(const Double3& centre, double size, Random& random) {
  std::vector<Double3> out;
  for (int c = 0; c < 3; ++c)
    out.push_back(centre +
                  Double3{random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5} * size);
  return out;
}

TEST(CrownHull, BringsPointsBackToWithinTheMargin) {
  const CrownHull hull(box_of_points({1, 1, 1}));
  EXPECT_NEAR(hull.width(), std::sqrt(3.0), 0.02);
  const std::vector<Double3> inside{{0.5, 0.5, 0.5}}, outside{{1.5, 0.5, 0.5}};
  EXPECT_EQ(hull.way_back(inside, 0), Double3{});
  EXPECT_NEAR(hull.way_back(outside, 0).x, -0.5, 0.01);
  EXPECT_NEAR(hull.way_back(outside, 0.2).x, -0.3, 0.01);
  EXPECT_NEAR(hull.excess(outside), 0.5, 0.01);
}

TEST(CrownHull, SaysOfAnyTriangleThatItFitsExactlyWhenItReachesNoFartherOutThanItMay) {
  Random random(7);
  for (const Double3& size :
       {Double3{1, 1, 1}, Double3{3, 1, 0.2}, Double3{1e-3, 1e3, 1}, Double3{1, 0, 1}}) {
    const CrownHull hull(box_of_points(size), 0.01);
    int fits = 0;
    for (int i = 0; i < 4000; ++i) {
      const Double3 at{random.uniform() * size.x, random.uniform() * size.y, random.uniform() * size.z};
      const auto triangle = triangle_about(at, 0.2 * hull.width() * random.uniform(), random);
      for (const double out : {0.01, 0.05}) {
        const bool is_in = hull.excess(triangle) <= out * hull.width();
        EXPECT_EQ(hull.fits(triangle, out), is_in);
        fits += is_in ? 1 : 0;
      }
    }
    EXPECT_GT(fits, 20);
    EXPECT_LT(fits, 8000);
  }
}

TEST(CrownHull, WhatIsMovedInFitsAndWhatIsTooLargeIsNot) {
  const CrownHull hull(box_of_points({1, 1, 1}));
  Random random(3);
  int moved = 0;
  for (int i = 0; i < 2000; ++i) {
    const Double3 at{1.4 * random.uniform() - 0.2, 1.4 * random.uniform() - 0.2,
                     1.4 * random.uniform() - 0.2};
    auto triangle = triangle_about(at, 0.5, random);
    const bool fits = hull.fits(triangle, 0.02);
    const auto move = hull.move_in(triangle, 0.02, 0.015);
    EXPECT_TRUE(!fits || move == Double3{});
    if (!move) continue;
    for (Double3& c : triangle) c += *move;
    EXPECT_LE(hull.excess(triangle), 0.0201 * hull.width());
    moved += *move == Double3{} ? 0 : 1;
  }
  EXPECT_GT(moved, 500);
  const std::vector<Double3> wide{{-0.5, 0.5, 0.5}, {1.5, 0.5, 0.5}, {0.5, 0.5, 0.6}};
  EXPECT_FALSE(hull.move_in(wide, 0.02, 0.015));
}

TEST(CrownHull, OfNothingOfOnePlaceAndFarFromTheOriginIsDefined) {
  const std::vector<Double3> points{{1, 2, 3}};
  const CrownHull none;
  EXPECT_LT(none.width(), 0);
  EXPECT_TRUE(none.fits(points, 0));
  EXPECT_EQ(none.way_back(points, 0.1), Double3{});
  EXPECT_EQ(none.move_in(points, 0, 0), Double3{});
  const CrownHull one(points);
  EXPECT_EQ(one.width(), 0);
  EXPECT_TRUE(one.fits(points, 0));
  EXPECT_FALSE(one.fits(std::vector<Double3>{{1, 2, 4}}, 0));
  std::vector<Double3> far = box_of_points({1, 1, 1});
  for (Double3& p : far) p += Double3{1e7, -1e7, 1e7};
  const CrownHull there(far, 0.01);
  EXPECT_TRUE(there.fits(std::vector<Double3>{{1e7 + 0.5, -1e7 + 0.5, 1e7 + 0.5}}, 0.01));
  EXPECT_FALSE(there.fits(std::vector<Double3>{{1e7 + 1.5, -1e7 + 0.5, 1e7 + 0.5}}, 0.01));
  const double nan = std::nan("");
  EXPECT_TRUE(is_finite(there.way_back(std::vector<Double3>{{1e7, -1e7, 1e7}}, 0)));
  (void)there.fits(std::vector<Double3>{{nan, nan, nan}}, 0.01);
}

}  // namespace
}  // namespace copse
