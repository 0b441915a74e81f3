#include "lib/analysis/boxes/minimal_box.h"

#include "lib/analysis/boxes/oriented_boxes.h"
#include "lib/analysis/volumes/volume_measures.h"
#include "tests/volumes/inside.h"
#include "tests/volumes/reference_models.h"

#include <set>

#include <gtest/gtest.h>

namespace copse {
namespace {

struct Fit {
  PointCloud cloud;
  BoundedFit<OrientedBox<double>> box;
  double volume() const { return cloud.frame.volume_out(measures_of(box.volume).volume); }
  double bound() const { return cloud.frame.volume_out(box.lower_bound); }
};

Fit fit(const std::vector<Double3>& points, const MinimalBoxOptions& options = {}) {
  const PointCloud cloud = make_point_cloud(points).value();
  return {cloud, minimal_box(convex_hull(cloud), options)};
}

TEST(MinimalBox, HasTheKnownVolumes) {
  const double known = 1e-8;
  EXPECT_EQ(fit(cube_corners()).volume(), 1);
  EXPECT_NEAR(fit({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}).volume(), 1, known);
  EXPECT_NEAR(fit(icosahedron()).volume(), 33.88854382, 33.9 * known);
  EXPECT_NEAR(fit(torus(40, 32, 0.5, 0.125)).volume(), 0.388220379, known);
  const double square = 2 + std::sqrt(3);  // round a regular twelve-gon of circumradius 1
  EXPECT_NEAR(fit(twig(10)).volume(), square * 1e-2, square * 1e-2 * known);
  EXPECT_NEAR(fit(twig(100)).volume(), square * 1e-4, square * 1e-4 * known);
  EXPECT_NEAR(fit(turned(twig(1e4), {1, 2, 3}, {2, 0, 1})).volume(), square * 1e-8, square * 1e-8 * 1e-7);
  EXPECT_NEAR(fit(turned(cube_corners(), {1, 2, 3}, {2, 0, 1})).volume(), 1, 1e-9);
  EXPECT_LE(fit(on_sphere(5, 1000)).volume(), 7.85);
}

TEST(MinimalBox, EnclosesEveryDegenerateSetAndIsNeverLargerThanTheQuickBoxes) {
  MinimalBoxOptions bounded;
  bounded.gap = 0.01;
  bounded.max_cells = 3000;
  for (const NamedPoints& set : degenerate_battery()) {
    for (const MinimalBoxOptions& options : {MinimalBoxOptions{}, bounded}) {
      const Fit f = fit(set.points, options);
      const double volume = measures_of(f.box.volume).volume;
      EXPECT_LE(outside_by(f.box.volume, f.cloud.points), 1e-15) << set.name;
      EXPECT_LE(f.box.lower_bound, volume) << set.name;
      EXPECT_LE(volume, measures_of(f.cloud.box).volume * (1 + 1e-12) + 1e-30) << set.name;
      EXPECT_LE(volume, measures_of(gaussian_box(f.cloud)).volume * (1 + 1e-12) + 1e-30) << set.name;
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(length(f.box.volume.axes[i]), 1, 1e-15) << set.name;
    }
  }
}

TEST(MinimalBox, OfFlatSetsIsTheRectangleOrTheSegment) {
  std::vector<Double3> grid, line;
  for (int i = 0; i < 70; ++i) grid.push_back({double(i % 10), double(i / 10), 0});
  for (int i = 0; i < 50; ++i) line.push_back(Double3{0.1, 0.2, 0.3} * double(i));
  const Fit g = fit(turned(grid, {1, 2, 3}, {-3, 1, 2})), l = fit(line);
  Double3 e = g.box.volume.half_extents * g.cloud.frame.scale * 2;
  EXPECT_NEAR(e.x * e.y + e.y * e.z + e.z * e.x, 54, 1e-11);
  EXPECT_LE(g.volume(), 1e-13);
  EXPECT_EQ(g.bound(), 0);
  e = l.box.volume.half_extents * l.cloud.frame.scale * 2;
  EXPECT_NEAR(std::max({e.x, e.y, e.z}), length(line.back()), 1e-13);
  EXPECT_LE(l.volume(), 1e-26);
}

TEST(MinimalBox, ProvesItsGapOnRandomClouds) {
  for (int seed = 0; seed < 6; ++seed) {
    MinimalBoxOptions options;
    options.gap = seed % 2 ? 1e-2 : 1e-3;
    const Fit f = fit(random_cloud(seed, 100, {1, .7, .2 + .2 * seed}), options);
    EXPECT_GE(f.bound() * (1 + options.gap), f.volume() * (1 - 1e-12)) << seed;
  }
}

// Both thin widths at once: what only combinations of pairs that lie across the length can bound.
TEST(MinimalBox, OfNeedlesAndPlatesIsProvenToOnePercentAtAnyAspect) {
  for (const double aspect : {1e2, 1e4, 1e6, 1e9}) {
    for (const Double3& half : {Double3{1, 1 / aspect, 0.7 / aspect}, Double3{1, 0.8, 1 / aspect}}) {
      MinimalBoxOptions options;
      options.gap = 0.01, options.max_cells = 50'000;
      const Fit f = fit(turned(random_cloud(3, 100, half), {1, 2, 3}, {-3, 1, 2}), options);
      EXPECT_GE(f.bound() * 1.0101, f.volume()) << aspect;
      EXPECT_LE(f.bound(), f.volume());
    }
  }
}

TEST(MinimalBox, IsTheSameForAnyOrderAndTheSameSizeForAnyPlace) {
  auto points = random_cloud(8, 300, {1, .6, .3});
  MinimalBoxOptions options;
  options.gap = 1e-3;
  const Fit f = fit(points, options);
  auto far = turned(points, {3, 1, 2}, {0, 1, 0});
  for (Double3& p : far) p = p * 1e5 + Double3{1e7, -1e7, 1e7};
  EXPECT_NEAR(fit(far, options).volume() * 1e-15, f.volume(), 1e-8 * f.volume());
  Random random(1);
  random.shuffle(std::span(points));
  const Fit other = fit(points, options);
  EXPECT_EQ(other.box.volume, f.box.volume);
  EXPECT_EQ(other.box.lower_bound, f.box.lower_bound);
}

TEST(MinimalBox, OfReferenceModelsIsTheBestKnownAndProvenToBe) {
  ASSERT_FALSE(reference_folder().empty()) << "no reference models: ./run installs libcgal-demo";
  const std::set<std::string> quick{"elephant", "blade", "couplingdown", "mushroom", "lion-head"};
  std::size_t tried = 0;
  for (const ReferenceModel& known : reference_models()) {
    if (!quick.contains(known.name)) continue;
    ++tried;
    const std::string& model = known.name;
    const double best = known.box;
    const std::vector<Double3> points = reference_points(model);
    ASSERT_GT(points.size(), 1000u) << model;
    EXPECT_LE(fit(points).volume(), best * 1.001) << model;
    MinimalBoxOptions options;
    options.gap = 1e-4;
    const Fit proven = fit(points, options);
    EXPECT_LE(proven.volume(), best * 1.00001) << model;
    EXPECT_LE(proven.bound(), best * 1.00001) << model;
    EXPECT_GE(proven.bound() * 1.0001, proven.volume() * (1 - 1e-12)) << model;
  }
  EXPECT_EQ(tried, quick.size());
}

}  // namespace
}  // namespace copse
