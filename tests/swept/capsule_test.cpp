#include "lib/analysis/swept/capsule.h"

#include "tests/volumes/point_sets.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

void expect_encloses(const Capsule<double>& c, const NamedPoints& s) {
  EXPECT_TRUE(std::isfinite(interior_volume(c))) << s.name;
  for (const Double3& p : s.points) EXPECT_LE(distance_from_segment(c, p), c.radius) << s.name;
}

TEST(Capsule, InteriorVolumeIsThatOfACylinderAndABall) {
  const double pi = std::numbers::pi;
  EXPECT_DOUBLE_EQ(interior_volume({{0, 0, 0}, {0, 0, 0}, 2}), 4.0 / 3.0 * pi * 8);
  EXPECT_DOUBLE_EQ(interior_volume({{0, 0, 0}, {0, 3, 4}, 2}), 4.0 / 3.0 * pi * 8 + pi * 4 * 5);
}

TEST(Capsule, DistanceIsFromTheNearestPlaceOnTheSegment) {
  const Capsule<double> c{{0, 0, 0}, {2, 0, 0}, 1};
  EXPECT_DOUBLE_EQ(distance_from_segment(c, {1, 3, 4}), 5);
  EXPECT_DOUBLE_EQ(distance_from_segment(c, {-3, 0, 4}), 5);
  EXPECT_DOUBLE_EQ(distance_from_segment(c, {5, 4, 0}), 5);
  EXPECT_DOUBLE_EQ(distance_from_segment({{1, 1, 1}, {1, 1, 1}, 1}, {1, 1, 4}), 3);
}

TEST(Capsule, EveryQuickWayEnclosesEverySet) {
  for (const auto& sets : {mixed_sets(), flat_sets()}) {
    for (const NamedPoints& s : sets) {
      expect_encloses(least_squares_capsule(s.points), s);
      expect_encloses(projected_circle_capsule(s.points), s);
    }
  }
}

TEST(Capsule, LeastSquaresRecoversACapsuleThatThePointsLieEvenlyOn) {
  Points p;
  for (int i = 0; i < 24; ++i) {
    const double a = 2 * std::numbers::pi * i / 24;
    for (const double y : {-1.0, 1.0}) p.push_back({0.25 * std::cos(a), y, 0.25 * std::sin(a)});
  }
  p.push_back({0, 1.25, 0}), p.push_back({0, -1.25, 0});
  const Capsule<double> c = least_squares_capsule(p);
  EXPECT_NEAR(c.radius, 0.25, 1e-14);
  EXPECT_NEAR(distance(c.a, c.b), 2, 1e-12);
}

TEST(Capsule, EndsAreWhereTheHalfSpheresTouch) {  // the seed's sign for xi1 would give a far longer one
  const Points p{{-1, 0, 0}, {1, 0, 0}, {0, 0.5, 0}, {0, -0.5, 0}, {0, 0, 0.5}, {0, 0, -0.5}};
  const Capsule<double> c = capsule_on_line(p, {0, 0, 0}, {1, 0, 0});
  EXPECT_DOUBLE_EQ(c.radius, 0.5);
  EXPECT_DOUBLE_EQ(distance(c.a, c.b), 1);
}

TEST(Capsule, ABlobGivesABall) {
  const Points p{{0.1, 0, 0}, {-0.1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  const Capsule<double> c = capsule_on_line(p, {0, 0, 0}, {1, 0, 0});
  EXPECT_EQ(c.a, c.b);
  EXPECT_DOUBLE_EQ(c.radius, 1);
}

TEST(Capsule, TheProjectedCircleIsNotLargerThanThatOfTheLineOfLeastSquares) {
  for (const NamedPoints& s : mixed_sets()) {
    EXPECT_LE(projected_circle_capsule(s.points).radius, least_squares_capsule(s.points).radius * (1 + 1e-7))
        << s.name;
  }
}

TEST(Capsule, OfPointsOnALineIsASegment) {
  const NamedPoints line = flat_sets()[3];
  const Capsule<double> c = least_squares_capsule(line.points);
  EXPECT_LT(c.radius, 0x1p-46);
  EXPECT_NEAR(distance(c.a, c.b), distance(line.points.front(), line.points.back()), 1e-15);
}

TEST(Capsule, OfNothingIsAPointAtTheOrigin) {
  EXPECT_EQ(least_squares_capsule({}), Capsule<double>{});
  EXPECT_EQ(projected_circle_capsule({}), Capsule<double>{});
}

}  // namespace
}  // namespace copse
