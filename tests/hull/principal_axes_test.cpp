#include "lib/analysis/hull/principal_axes.h"

#include "lib/analysis/hull/point_cloud.h"
#include "tests/volumes/point_sets.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

using Points = std::vector<Double3>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

TEST(PrincipalAxes, OfPointsOnThreeCrossedSegmentsAreThose) {
  Points points;
  const Double3 u = normalized({1, 2, 3}), v = normalized(cross(u, {0, 0, 1})), w = cross(u, v);
  for (const double s : {-1., 1.}) {
    points.push_back(Double3{.1, .2, .3} + v * (1.5 * s));
    points.push_back(Double3{.1, .2, .3} + u * s);
    points.push_back(Double3{.1, .2, .3} + w * (.5 * s));
  }
  const PrincipalAxes p = principal_axes(points);
  EXPECT_NEAR(distance(p.mean, {.1, .2, .3}), 0, 1e-15);
  EXPECT_NEAR(std::abs(dot(p.axes[0], v)), 1, 1e-14);
  EXPECT_NEAR(std::abs(dot(p.axes[1], u)), 1, 1e-14);
  EXPECT_NEAR(length(cross(p.axes[0], p.axes[1]) - p.axes[2]), 0, 1e-15);
  EXPECT_NEAR(p.variances[0], 0.75, 1e-14);
  EXPECT_NEAR(p.variances[2], 1. / 12, 1e-14);
}

TEST(PrincipalAxes, NotOneBitDependsOnOrderOrRepetition) {
  Points points = random_cloud(1, 5000, {1, 0.7, 0.1});
  const PrincipalAxes p = principal_axes(points);
  Random random(2);
  for (int round = 0; round < 3; ++round) {
    for (int i = 0; i < 100; ++i) points.push_back(points[random.below(5000)]);
    random.shuffle(std::span(points));
    const PrincipalAxes q = principal_axes(points);
    EXPECT_EQ(p.mean, q.mean);
    EXPECT_EQ(p.axes, q.axes);
    EXPECT_EQ(p.variances, q.variances);
  }
}

TEST(PrincipalAxes, OfASurfaceCountItsAreaNotItsVertices) {
  // A rectangle 4 x 1, cut into many triangles at one end.
  Points points{{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {0, 1, 0}};
  Triangles plain{{0, 1, 2}, {0, 2, 3}}, cut{{0, 1, 2}};
  for (int i = 0; i <= 50; ++i) points.push_back({0, 1 - i / 50., 0});
  for (std::uint32_t i = 0; i < 50; ++i) cut.push_back({2, 4 + i, 5 + i});
  for (const Triangles& t : {plain, cut}) {
    const PrincipalAxes p = principal_axes(points, t);
    EXPECT_NEAR(distance(p.mean, {2, .5, 0}), 0, 1e-14);
    EXPECT_NEAR(p.variances[0], 16. / 12, 1e-13);
    EXPECT_NEAR(p.variances[1], 1. / 12, 1e-14);
    EXPECT_NEAR(p.variances[2], 0, 1e-15);
  }
  EXPECT_LT(principal_axes(points).mean.x, 0.2);
}

TEST(PrincipalAxes, WithoutAreaAreThoseOfThePoints) {
  const Points points = random_cloud(3, 20, {1, 1, 1});
  EXPECT_EQ(principal_axes(points, Triangles{{0, 0, 1}, {2, 2, 2}}).axes, principal_axes(points).axes);
}

TEST(PrincipalAxes, AreOrthonormalForEveryDegenerateSet) {
  for (const NamedPoints& set : degenerate_battery()) {
    const PrincipalAxes p = principal_axes(make_point_cloud(set.points).value().points);
    EXPECT_TRUE(is_finite(p.mean)) << set.name;
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(length(p.axes[i]), 1, 1e-15) << set.name;
      EXPECT_NEAR(dot(p.axes[i], p.axes[(i + 1) % 3]), 0, 1e-15) << set.name;
    }
  }
  EXPECT_EQ(principal_axes({}).axes, k_world_axes);
}

}  // namespace
}  // namespace copse
