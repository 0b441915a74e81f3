#include "lib/analysis/swept/lozenge.h"

#include "tests/volumes/point_sets.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(Lozenge, InteriorVolumeIsThatOfItsParts) {
  const double pi = std::numbers::pi;
  const Lozenge<double> l{{0, 0, 0}, {3, 0, 0}, {0, 2, 0}, 0.5};
  EXPECT_DOUBLE_EQ(interior_volume(l), 6 + pi * 0.25 * 5 + 4.0 / 3.0 * pi * 0.125);
}

TEST(Lozenge, DistanceIsFromTheNearestPlaceOnTheRectangle) {
  const Lozenge<double> l{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, 1};
  EXPECT_DOUBLE_EQ(distance_from_rectangle(l, {1, 0.5, 3}), 3);
  EXPECT_DOUBLE_EQ(distance_from_rectangle(l, {5, 0.5, 4}), 5);
  EXPECT_DOUBLE_EQ(distance_from_rectangle(l, {-2, 3, 1}), 3);
  EXPECT_DOUBLE_EQ(distance_from_rectangle({{1, 0, 0}, {}, {}, 1}, {1, 0, 2}), 2);
}

TEST(Lozenge, EnclosesEverySet) {
  for (const auto& sets : {mixed_sets(), flat_sets()}) {
    for (const NamedPoints& s : sets) {
      const Lozenge<double> l = gaussian_lozenge(s.points);
      EXPECT_TRUE(std::isfinite(interior_volume(l))) << s.name;
      for (const Double3& p : s.points) EXPECT_LE(distance_from_rectangle(l, p), l.radius) << s.name;
    }
  }
}

TEST(Lozenge, TheCornerStepNeedsNoLargerRadius) {  // without it a third of random clouds stick out
  Random random(9);
  int moved = 0;
  for (int k = 0; k < 200; ++k) {
    const Points p = repeated(12, [&] { return in_box(random, {1, 0.7, 0.4}); });
    DoubleBox box;
    for (const Double3& q : p) box.grow(q);
    const Lozenge<double> l = lozenge_in_frame(p, k_world_axes);
    EXPECT_NEAR(l.radius, box.extent().z / 2, 1e-14);
    double low = 1e9;
    for (const Double3& q : p) {
      const double h = q.z - box.centre().z, r = box.extent().z / 2;
      low = std::min(low, q.x + std::sqrt(std::max(0.0, r * r - h * h)));
    }
    moved += l.origin.x < low - 1e-9;
  }
  EXPECT_GT(moved, 10);
}

TEST(Lozenge, OfItsOwnCornersAndPolesIsItself) {
  const Points p{{0, 0, 0.25},  {1, 0, 0.25}, {0, 2, -0.25},   {1, 2, -0.25},
                 {-0.25, 1, 0}, {1.25, 1, 0}, {0.5, -0.25, 0}, {0.5, 2.25, 0}};
  const Lozenge<double> l = lozenge_in_frame(p, k_world_axes);
  EXPECT_DOUBLE_EQ(l.radius, 0.25);
  EXPECT_DOUBLE_EQ(length(l.edge0), 1);
  EXPECT_DOUBLE_EQ(length(l.edge1), 2);
}

TEST(Lozenge, OfPlanarPointsHasNoThickness) {
  for (const NamedPoints& s : flat_sets()) EXPECT_LT(gaussian_lozenge(s.points).radius, 0x1p-46) << s.name;
}

TEST(Lozenge, OfNothingIsAPointAtTheOrigin) {
  EXPECT_EQ(gaussian_lozenge({}), Lozenge<double>{});
}

}  // namespace
}  // namespace copse
