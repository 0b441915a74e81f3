#include "lib/analysis/hull/hull_loss.h"

#include "tests/volumes/point_sets.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(HullLoss, IsAtLeastTheDistanceAndNotMuchMore) {
  const ConvexHull hull = convex_hull(make_point_cloud(on_sphere(1, 300)).value());
  EXPECT_LE(hull_loss(hull, hull.vertices), 1e-14);
  const std::vector<Double3> middle{hull.box.centre()};
  EXPECT_EQ(hull_loss(hull, middle), 0);
  const double unit = 1 / hull.frame.scale;
  for (const Double3& p : on_sphere(2, 200)) {
    const std::vector<Double3> out{hull.frame.in(p * 1.5)};
    double plane = 0;  // the largest distance from a facet's plane is a lower bound
    for (const auto& f : hull.faces) {
      const Double3 a = hull.vertices[f[0]];
      plane = std::max(plane,
                       dot(normalized(cross(hull.vertices[f[1]] - a, hull.vertices[f[2]] - a)), out[0] - a));
    }
    const double loss = hull_loss(hull, out);
    EXPECT_GE(loss, plane * (1 - 1e-12));
    EXPECT_LE(loss, 0.75 * unit);
  }
}

TEST(HullLoss, OfAKernelIsReportedByTheHullAndCoversEveryPoint) {
  const PointCloud cloud = make_point_cloud(on_sphere(3, 20000)).value();
  const ConvexHull hull = convex_hull(cloud, {.max_corners = 1000});
  EXPECT_LE(hull.vertices.size(), 1000u);
  EXPECT_EQ(hull.boundary.size(), 20000u);
  EXPECT_GT(hull.loss, 0);
  EXPECT_LT(hull.loss, 0.02);
  for (const auto& f : hull.faces) {
    const Double3 a = hull.vertices[f[0]];
    const Double3 n = normalized(cross(hull.vertices[f[1]] - a, hull.vertices[f[2]] - a));
    double worst = 0;
    for (std::size_t i = 0; i < cloud.points.size(); i += 37)
      worst = std::max(worst, dot(n, cloud.points[i] - a));
    EXPECT_LE(worst, hull.loss);
  }
}

// Two facets of as many triangles as there are sides: a walk may not end amid them.
TEST(HullLoss, OfADrumIsSeenFromBothItsEnds) {
  constexpr int k_sides = 12000;
  std::vector<Double3> drum;
  for (int i = 0; i < k_sides; ++i) {
    const double turn = 2 * std::numbers::pi * i / k_sides;
    for (const double z : {0.0, 1.0}) drum.push_back({std::cos(turn), std::sin(turn), z});
  }
  const PointCloud cloud = make_point_cloud(drum).value();
  const ConvexHull hull = convex_hull(cloud, {.max_corners = 1000});
  const double corners = double(hull.vertices.size()) / 2, unit = 1 / hull.frame.scale;
  EXPECT_GE(hull.loss, 0.99 * unit * (1 - std::cos(std::numbers::pi / corners)));
  // The boundary reaches as far as all points do, in every direction.
  for (int i = 0; i < 500; ++i) {
    const double turn = 0.1 + 2.3 * i;
    const Double3 n{std::cos(turn), std::sin(turn), i % 2 == 0 ? 0.3 : -0.3};
    const auto reach = [&](const std::vector<Double3>& points) {
      double most = -1e300;
      for (const Double3& p : points) most = std::max(most, dot(n, p));
      return most;
    };
    EXPECT_NEAR(reach(hull.boundary), reach(cloud.points), 1e-9 * unit) << i;
  }
}

}  // namespace
}  // namespace copse
