#include "lib/analysis/round/bounding_spheres.h"

#include "tests/volumes/inside.h"

#include <numbers>

#include <gtest/gtest.h>

namespace copse {
namespace {

double radius_out(const PointCloud& cloud, double radius) {
  return radius * cloud.frame.scale;
}

TEST(BoundingSpheres, EncloseEveryAwkwardSetAndTheSmallestIsTheSmallest) {
  for (const NamedPoints& set : degenerate_battery()) {
    const PointCloud cloud = make_point_cloud(set.points).value();
    const SupportedSphere smallest = smallest_sphere(cloud);
    for (const auto& s :
         {box_sphere(cloud), mean_sphere(cloud), extremal_sphere(cloud), smallest.fit.volume}) {
      EXPECT_LE(outside_by(s, cloud.points), 1e-15) << set.name;
      EXPECT_GE(s.radius, smallest.fit.volume.radius * (1 - 1e-12)) << set.name;
    }
    const double volume = 4 * std::numbers::pi / 3 * std::pow(smallest.fit.volume.radius, 3);
    EXPECT_LE(smallest.fit.lower_bound, volume) << set.name;
    EXPECT_GE(smallest.fit.lower_bound, volume * (1 - 1e-11)) << set.name;
  }
}

TEST(BoundingSpheres, TheSupportLiesOnTheSmallestAndHoldsIt) {
  for (const NamedPoints& set : degenerate_battery()) {
    const PointCloud cloud = make_point_cloud(set.points).value();
    const SupportedSphere s = smallest_sphere(cloud);
    ASSERT_GE(s.support.size(), 1u) << set.name;
    ASSERT_LE(s.support.size(), 4u) << set.name;
    std::vector<Double3> support;
    for (const std::uint32_t i : s.support) {
      support.push_back(cloud.points[i]);
      EXPECT_NEAR(distance(cloud.points[i], s.fit.volume.centre), s.fit.volume.radius, 1e-12) << set.name;
    }
    // The ball of the support alone is the ball of all.
    const SupportedSphere alone = smallest_sphere(make_point_cloud(support).value());
    const double scale = make_point_cloud(support).value().frame.scale;
    EXPECT_NEAR(alone.fit.volume.radius * scale, s.fit.volume.radius, 1e-12) << set.name;
  }
}

TEST(BoundingSpheres, HaveTheKnownVolumes) {
  const auto volume = [](const std::vector<Double3>& points) {
    const PointCloud cloud = make_point_cloud(points).value();
    return 4 * std::numbers::pi / 3 *
           std::pow(radius_out(cloud, smallest_sphere(cloud).fit.volume.radius), 3);
  };
  std::vector<Double3> line, grid;
  for (int i = 0; i < 50; ++i) line.push_back(Double3{0.1, 0.2, 0.3} * double(i));
  for (int i = 0; i < 70; ++i) grid.push_back({double(i % 10), double(i / 10), 0});
  EXPECT_NEAR(volume(line), 3226.851027, 1e-6);
  EXPECT_NEAR(volume(grid), 662.6396438, 1e-7);
  EXPECT_NEAR(volume(cube_corners()), 2.720699046, 1e-9);
  EXPECT_NEAR(volume({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), 2.280088587, 2e-9 + 1e-9);
  EXPECT_NEAR(volume(torus(40, 32, 0.5, 0.125)), 1.022653859, 1e-9);
  EXPECT_NEAR(volume(icosahedron()), 28.82687553, 1e-8);
}

TEST(BoundingSpheres, NotOneBitDependsOnTheOrder) {
  for (const NamedPoints& set : degenerate_battery()) {
    auto points = set.points;
    const PointCloud cloud = make_point_cloud(points).value();
    Random random(1);
    random.shuffle(std::span(points));
    const PointCloud other = make_point_cloud(points).value();
    EXPECT_EQ(smallest_sphere(other).fit.volume, smallest_sphere(cloud).fit.volume) << set.name;
    EXPECT_EQ(extremal_sphere(other), extremal_sphere(cloud)) << set.name;
    EXPECT_EQ(mean_sphere(other), mean_sphere(cloud)) << set.name;
  }
}

}  // namespace
}  // namespace copse
