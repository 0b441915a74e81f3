#include "lib/analysis/round/ellipsoids.h"

#include "lib/analysis/volumes/volume_measures.h"
#include "tests/volumes/inside.h"

#include <numbers>

#include <gtest/gtest.h>

namespace copse {
namespace {

double volume_of(const Ellipsoid<double>& e) {
  return measures_of(e).volume;
}

TEST(Ellipsoids, EncloseEveryAwkwardSetUpToRounding) {
  for (const NamedPoints& set : degenerate_battery()) {
    const PointCloud cloud = make_point_cloud(set.points).value();
    const ConvexHull hull = convex_hull(cloud);
    const BoundedFit<Ellipsoid<double>> minimal = minimal_ellipsoid(hull);
    for (const auto& e : {axis_aligned_ellipsoid(cloud), gaussian_ellipsoid(cloud), minimal.volume}) {
      EXPECT_TRUE(is_finite(e.centre) && is_finite(e.semi_axes)) << set.name;
      EXPECT_LE(outside_by(e, cloud.points), 3e-14) << set.name;
    }
    EXPECT_LE(minimal.lower_bound, volume_of(minimal.volume)) << set.name;
    if (hull.dimension < 3) {
      EXPECT_EQ(minimal.lower_bound, 0) << set.name;
      EXPECT_EQ(volume_of(minimal.volume), 0) << set.name;
    } else {
      EXPECT_LE(volume_of(minimal.volume), minimal.lower_bound * (1 + 1e-3)) << set.name;
      EXPECT_LE(volume_of(minimal.volume), volume_of(gaussian_ellipsoid(cloud)) * (1 + 1e-5)) << set.name;
      EXPECT_LE(volume_of(minimal.volume), volume_of(axis_aligned_ellipsoid(cloud)) * (1 + 1e-5)) << set.name;
    }
  }
}

TEST(Ellipsoids, MinimalHasTheKnownVolumes) {
  const auto volume = [](const std::vector<Double3>& points) {
    const ConvexHull hull = convex_hull(make_point_cloud(points).value());
    return hull.frame.volume_out(volume_of(minimal_ellipsoid(hull, {1e-8, 100'000}).volume));
  };
  // Of an affine image of a regular body it is the image of the ball.
  const double cube = 4 * std::numbers::pi / 3 * std::pow(0.75, 1.5);
  EXPECT_NEAR(volume(cube_corners()), cube, 1e-7);
  auto brick = cube_corners();
  for (Double3& p : brick) p = {10 * p.x + 3 * p.y, p.y, 0.001 * p.z + p.x};
  EXPECT_NEAR(volume(brick), 0.01 * cube, 1e-9);
  // The tetrahedron's has 3 sqrt(3) / 2 ... of a simplex: ratio to the simplex is that of the regular one.
  const double ratio = 4 * std::numbers::pi / 3 * std::pow(std::sqrt(3.0 / 8), 3) * 6 * std::sqrt(2.0);
  EXPECT_NEAR(volume({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), ratio / 6, 1e-7);
  EXPECT_NEAR(volume(icosahedron()), 28.82687553, 1e-6);
}

TEST(Ellipsoids, OfFlatPointsAreTheEllipseAndTheSegment) {
  std::vector<Double3> circle;
  for (int i = 0; i < 64; ++i)
    circle.push_back({5 * std::cos(i * std::numbers::pi / 32), 2 * std::sin(i * std::numbers::pi / 32), 0});
  const ConvexHull hull = convex_hull(make_point_cloud(turned(circle, {1, 2, 3}, {0, 1, 1})).value());
  const Ellipsoid<double> e = placed(minimal_ellipsoid(hull).volume, hull.frame);
  EXPECT_NEAR(e.semi_axes.x, 5, 1e-4);
  EXPECT_NEAR(e.semi_axes.y, 2, 1e-4);
  EXPECT_EQ(e.semi_axes.z, 0);
  const ConvexHull segment =
      convex_hull(make_point_cloud(std::vector<Double3>{{1, 2, 3}, {3, 2, 3}, {2, 2, 3}}).value());
  EXPECT_NEAR(placed(minimal_ellipsoid(segment).volume, segment.frame).semi_axes.x, 1, 1e-12);
}

TEST(Ellipsoids, MoreStepsGiveNoLargerOneAndNoLowerBound) {
  for (const std::uint64_t seed : {3, 4, 5, 6}) {
    const ConvexHull hull = convex_hull(make_point_cloud(random_cloud(seed, 300, {1, .6, .3})).value());
    const auto volume_after = [&](int steps) {
      const auto fit = minimal_ellipsoid(hull, {.gap = 1e-9, .max_steps = steps});
      return std::pair(fit.volume.semi_axes.x * fit.volume.semi_axes.y * fit.volume.semi_axes.z,
                       fit.lower_bound);
    };
    auto before = volume_after(1);
    for (int steps = 2; steps < 120; ++steps) {
      const auto now = volume_after(steps);
      EXPECT_LE(now.first, before.first * (1 + 1e-9)) << steps;
      EXPECT_GE(now.second, before.second * (1 - 1e-9)) << steps;
      before = now;
    }
  }
}

TEST(Ellipsoids, MinimalIsTheSameForAnyOrder) {
  auto points = random_cloud(8, 300, {1, .6, .3});
  const auto fit = [&] { return minimal_ellipsoid(convex_hull(make_point_cloud(points).value())); };
  const auto first = fit();
  Random random(1);
  random.shuffle(std::span(points));
  EXPECT_EQ(fit().volume, first.volume);
  EXPECT_EQ(fit().lower_bound, first.lower_bound);
}

}  // namespace
}  // namespace copse
