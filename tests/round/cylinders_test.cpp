#include "lib/analysis/round/cylinders.h"

#include "lib/analysis/volumes/volume_measures.h"
#include "tests/volumes/inside.h"

#include <numbers>

#include <gtest/gtest.h>

namespace copse {
namespace {

constexpr double k_pi = std::numbers::pi;

double volume_of(const Cylinder<double>& c) {
  return measures_of(c).volume;
}

TEST(Cylinders, EncloseEveryAwkwardSetInTheirOrderOfSize) {
  MinimalCylinderOptions options;
  options.max_cells = 300;
  for (const NamedPoints& set : degenerate_battery()) {
    const PointCloud cloud = make_point_cloud(set.points).value();
    const ConvexHull hull = convex_hull(cloud);
    const Cylinder<double> line = line_fit_cylinder(cloud), centred = recentred_cylinder(cloud);
    const BoundedFit<Cylinder<double>> minimal = minimal_cylinder(hull, options);
    for (const auto& c : {line, centred, minimal.volume}) {
      EXPECT_LE(outside_by(c, cloud.points), 2e-15) << set.name;
      EXPECT_GT(distance(c.a, c.b), 0) << set.name;
    }
    EXPECT_LE(volume_of(centred), volume_of(line) * (1 + 1e-9) + 1e-7) << set.name;
    if (hull.dimension == 3) {
      EXPECT_LE(volume_of(minimal.volume), volume_of(centred) * (1 + 1e-12)) << set.name;
    }
    EXPECT_LE(minimal.lower_bound, volume_of(minimal.volume) * (1 + 1e-12)) << set.name;
    if (hull.dimension < 3) {
      EXPECT_EQ(minimal.lower_bound, 0) << set.name;
    }
  }
}

TEST(Cylinders, MinimalOfACylinderIsIt) {
  std::vector<Double3> points;
  for (int i = 0; i < 60; ++i) {
    const double a = i * k_pi / 30;
    points.push_back({0, std::cos(a), std::sin(a)}), points.push_back({5, std::cos(a), std::sin(a)});
  }
  for (const auto& set : {points, turned(points, {1, 2, 3}, {0, 1, 1})}) {
    const ConvexHull hull = convex_hull(make_point_cloud(set).value());
    const auto fit = minimal_cylinder(hull);
    EXPECT_NEAR(hull.frame.volume_out(volume_of(fit.volume)), 5 * k_pi, 1e-6);
    EXPECT_GE(fit.lower_bound * 1.001, volume_of(fit.volume) * (1 - 1e-9));
  }
}

// No direction, however found, may give less than the bound.
TEST(Cylinders, TheBoundIsBelowEveryCylinderThatCanBeFound) {
  for (int seed = 0; seed < 6; ++seed) {
    const Double3 size = seed % 3 == 0   ? Double3{1, .1, .1}
                         : seed % 3 == 1 ? Double3{1, .9, .8}
                                         : Double3{1, 1, .05};
    const ConvexHull hull = convex_hull(
        make_point_cloud(seed % 2 ? random_cloud(seed, 40, size) : on_sphere(seed, 20 + seed)).value());
    Random random(seed);
    Double3 at{1, 0, 0};
    double best = volume_of(cylinder_along(hull.vertices, at));
    for (int i = 0; i < 2000; ++i) {
      const double reach = i < 500 ? 1 : std::pow(0.99, i - 500);
      const Double3 d = normalized(
          at + Double3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)} * reach);
      const double volume = volume_of(cylinder_along(hull.vertices, d));
      if (volume < best) best = volume, at = d;
    }
    for (const std::size_t cells : {10u, 100u, 20000u}) {
      MinimalCylinderOptions options;
      options.max_cells = cells;
      const auto fit = minimal_cylinder(hull, options);
      EXPECT_LE(fit.lower_bound, best * (1 + 1e-12)) << seed;
      if (cells == 20000u) {
        EXPECT_LE(volume_of(fit.volume), best * 1.001) << seed;
      }
    }
  }
}

TEST(Cylinders, OfNeedlesAreProvenToo) {  // the disc across one is low, but not lower than a ball in it
  for (const double aspect : {1e3, 1e5, 1e6}) {
    const ConvexHull hull = convex_hull(
        make_point_cloud(turned(random_cloud(3, 200, {1, 1 / aspect, 1 / aspect}), {1, 2, 3}, {-3, 1, 2}))
            .value());
    MinimalCylinderOptions options;
    options.gap = 0.01, options.max_cells = 20'000;
    const auto fit = minimal_cylinder(hull, options);
    EXPECT_GE(fit.lower_bound * 1.01001, volume_of(fit.volume)) << aspect;
  }
}

// The kernel's points are round, what it gave away is not: what is least round one need not be round all.
TEST(Cylinders, TheProofGivesNoneLargerThanTheSearchRoundAKernelAndReachesItsGapRoundAll) {
  for (int seed = 0; seed < 3; ++seed) {
    std::vector<Double3> points = on_sphere(seed, 4000);
    for (Double3& p : points) p = {p.x, 0.999 * p.y, 1.001 * p.z};
    const ConvexHull hull = convex_hull(make_point_cloud(points).value(), {.max_corners = 300});
    ASSERT_GT(hull.loss, 0);
    ASSERT_GT(hull.boundary.size(), hull.vertices.size());
    MinimalCylinderOptions searched, proven;
    searched.gap = std::numeric_limits<double>::infinity();
    proven.gap = 0.05, proven.max_cells = 20'000;
    const auto quick = minimal_cylinder(hull, searched), fit = minimal_cylinder(hull, proven);
    EXPECT_LE(volume_of(fit.volume), volume_of(quick.volume)) << seed;
    EXPECT_LE(volume_of(fit.volume), fit.lower_bound * (1 + proven.gap + 1e-9)) << seed;
  }
}

TEST(Cylinders, OfFlatSetsAreADiscAndATube) {
  std::vector<Double3> circle, line;
  for (int i = 0; i < 64; ++i) circle.push_back({std::cos(i * k_pi / 32), std::sin(i * k_pi / 32), 0});
  for (int i = 0; i < 50; ++i) line.push_back(Double3{0.1, 0.2, 0.3} * double(i));
  const ConvexHull c = convex_hull(make_point_cloud(circle).value()),
                   l = convex_hull(make_point_cloud(line).value());
  const Cylinder<double> disc = placed(minimal_cylinder(c).volume, c.frame),
                         tube = placed(minimal_cylinder(l).volume, l.frame);
  EXPECT_NEAR(disc.radius, 1, 1e-12);
  EXPECT_LE(distance(disc.a, disc.b), 2e-7);
  EXPECT_NEAR(distance(tube.a, tube.b), length(line.back()), 1e-12);
  EXPECT_LE(tube.radius, 1e-14);
}

}  // namespace
}  // namespace copse
