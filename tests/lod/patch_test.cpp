#include "lib/analysis/lod/patch.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

const std::array<Double3, 3> k_right{{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}}};

TEST(Patch, OfATriangleHasItsMoments) {
  const Patch p = patch_of(k_right, 0.5, 0.25);
  EXPECT_DOUBLE_EQ(p.area, 4.5);
  EXPECT_DOUBLE_EQ(p.opaque, 2.25);
  EXPECT_DOUBLE_EQ(p.visible, 0.5625);
  EXPECT_NEAR(distance(p.centre(), {1, 1, 0}), 0, 1e-12);
  // variance of a right triangle's leg of length a: a^2 / 18; covariance -a^2 / 36
  const Symmetric3 c = p.covariance();
  EXPECT_NEAR(c.m[0], 0.5, 1e-12);
  EXPECT_NEAR(c.m[1], 0.5, 1e-12);
  EXPECT_NEAR(c.m[3], -0.25, 1e-12);
  EXPECT_NEAR(c.m[2], 0, 1e-12);
  EXPECT_NEAR(p.facing.along({0, 0, 1}), 4.5, 1e-12);
}

TEST(Patch, OfTwoHalvesIsThatOfTheWhole) {
  Patch halves = patch_of({{{0, 0, 0}, {3, 0, 0}, {1.5, 1.5, 0}}}, 1, 1);
  halves += patch_of({{{0, 0, 0}, {1.5, 1.5, 0}, {0, 3, 0}}}, 1, 1);
  const Patch whole = patch_of(k_right, 1, 1);
  EXPECT_NEAR(halves.area, whole.area, 1e-12);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(halves.covariance().m[i], whole.covariance().m[i], 1e-12);
}

TEST(Patch, WithoutAreaIsDefined) {
  const Patch p = patch_of({{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}}, 1, 1);
  EXPECT_EQ(p.area, 0);
  EXPECT_TRUE(is_finite(p.centre()));
  EXPECT_EQ(p.covariance().trace(), 0);
}

TEST(Patch, EigenvectorsTakeTheMatrixApart) {
  Symmetric3 m;
  const Double3 a = normalized({1, 2, 3}), b = normalized(cross(a, {0, 0, 1})), c = cross(a, b);
  m.add(a, 5), m.add(b, 2), m.add(c, 0.1);
  const Eigen3 e = eigen(m);
  EXPECT_NEAR(e.values[0], 5, 1e-12);
  EXPECT_NEAR(e.values[1], 2, 1e-12);
  EXPECT_NEAR(e.values[2], 0.1, 1e-12);
  EXPECT_NEAR(std::abs(dot(e.vectors[0], a)), 1, 1e-12);
  EXPECT_NEAR(dot(cross(e.vectors[0], e.vectors[1]), e.vectors[2]), 1, 1e-12) << "right-handed";
}

TEST(Patch, EigenvectorsOfNothingOrOfABallAreABasis) {
  for (const double size : {0.0, 1.0, 1e-300, 1e150}) {
    const Eigen3 e = eigen({{size, size, size, 0, 0, 0}});
    EXPECT_EQ(e.values[0], size);
    EXPECT_NEAR(dot(cross(e.vectors[0], e.vectors[1]), e.vectors[2]), 1, 1e-12);
  }
}

}  // namespace
}  // namespace copse
