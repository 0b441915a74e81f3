#include "lib/analysis/round/smallest_circle.h"

#include "lib/analysis/round/minimal_sphere.h"
#include "lib/formats/random.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace copse {
namespace {

using Plane = std::vector<Vec2<double>>;

double reach(const SmallestCircle& c, const Plane& points) {
  double most = 0;
  for (const auto& p : points) most = std::max(most, std::hypot(p.x - c.centre.x, p.y - c.centre.y));
  return most;
}

TEST(SmallestCircle, OfNothingOfAPointAndOfTwo) {
  EXPECT_EQ(smallest_circle({}).radius, 0);
  const SmallestCircle point = smallest_circle(Plane{{0.3, -0.4}});
  EXPECT_EQ(point.radius, 0);
  EXPECT_EQ(point.centre.x, 0.3);
  const SmallestCircle two = smallest_circle(Plane{{0, 0}, {0.6, 0.8}});
  EXPECT_DOUBLE_EQ(two.radius, 0.5);
  EXPECT_EQ(two.supports, 2);
}

TEST(SmallestCircle, IsTheSmallestBallsOfThePointsInThatPlane) {
  Random random(1);
  for (int round = 0; round < 2000; ++round) {
    Plane points;
    std::vector<Double3> space;
    const double thin = std::pow(10, -random.uniform(0, 12));
    const int n = 1 + static_cast<int>(random.below(12));
    for (int i = 0; i < n; ++i) {
      points.push_back({random.around(0, 1), random.around(0, thin)});
      if (round % 3 == 0) points.back() = {random.below(3) / 2.0, random.below(3) / 2.0};  // many equal
      if (round % 3 == 1) {  // many on one circle
        const double a = random.below(12) * std::numbers::pi / 6;
        points.back() = {std::cos(a), std::sin(a)};
      }
      space.push_back({points.back().x, points.back().y, 0});
    }
    const SmallestCircle c = smallest_circle(points);
    const double truth = minimal_sphere(space).radius;
    EXPECT_NEAR(c.radius, truth, 1e-12 * truth + 1e-16) << round;
    EXPECT_LE(c.lower_radius, truth * (1 + 1e-12) + 1e-16) << round;
    EXPECT_GE(c.lower_radius, truth * (1 - 1e-12) - 1e-16) << round;
    EXPECT_LE(reach(c, points), c.radius * (1 + 1e-15)) << round;
    for (int i = 0; i < c.supports; ++i) {
      const auto& p = points[c.support[i]];
      EXPECT_NEAR(std::hypot(p.x - c.centre.x, p.y - c.centre.y), c.radius, 1e-9 * c.radius + 1e-16) << round;
    }
  }
}

TEST(SmallestCircle, OfASymmetricSetIsBoundedFromBelowByItself) {
  Plane points;  // three pairs about one middle, the last a little wider
  for (const double a : {0.3, 1.3, 2.3}) {
    const double r = a > 2 ? 1 + 1e-3 : 1;
    points.push_back({r * std::cos(a), r * std::sin(a)}),
        points.push_back({-r * std::cos(a), -r * std::sin(a)});
  }
  const SmallestCircle c = smallest_circle(points);
  EXPECT_NEAR(c.radius, 1 + 1e-3, 1e-15);
  EXPECT_NEAR(c.lower_radius, 1 + 1e-3, 1e-12);
}

TEST(SmallestCircle, IsTheSameToTheBitInAnyOrder) {
  Random random(3);
  for (int round = 0; round < 300; ++round) {
    std::vector<Vec2<double>> points;
    for (int i = 0; i < 7; ++i) points.push_back({random.around(0, 1), 0.25 * double(random.below(9))});
    const SmallestCircle circle = smallest_circle(points);
    random.shuffle(std::span(points));
    const SmallestCircle other = smallest_circle(points);
    ASSERT_EQ(other.centre, circle.centre) << round;
    ASSERT_EQ(other.radius, circle.radius) << round;
  }
}

TEST(SmallestCircle, FromLikelyPointsIsTheSameCircle) {
  Random random(9);
  for (int n = 1; n < 40; ++n) {
    std::vector<Vec2<double>> points;
    for (int i = 0; i < n; ++i) points.push_back({random.around(0, 1), random.around(0, 0.3)});
    const SmallestCircle plain = smallest_circle(points);
    for (int k = 0; k < 6; ++k) {
      std::vector<std::uint32_t> likely;
      for (int i = 0; i < std::min(n, 1 + k % 3); ++i)
        likely.push_back(static_cast<std::uint32_t>((k * 7 + i) % n));
      EXPECT_NEAR(smallest_circle(points, likely).radius, plain.radius, 1e-12) << n;
    }
  }
}

}  // namespace
}  // namespace copse
