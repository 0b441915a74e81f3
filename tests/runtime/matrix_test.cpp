#include "lib/runtime/matrix.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

void expect_near(const Float4& a, const Float4& b, float tolerance = 1e-6f) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
  EXPECT_NEAR(a.w, b.w, tolerance);
}

TEST(Matrix, PerspectivePutsNearAtMinusOneAndFarAtOne) {
  const Mat4 p = perspective(-1, 1, -1, 1, 2, 10);
  const Float4 near_point = transform(p, {0, 0, -2, 1}), far_point = transform(p, {0, 0, -10, 1});
  EXPECT_FLOAT_EQ(near_point.z / near_point.w, -1);
  EXPECT_FLOAT_EQ(far_point.z / far_point.w, 1);
}

TEST(Matrix, PerspectivePutsTheCornersOfAnOffCentreImageInTheCorners) {
  const Mat4 p = perspective(-0.25, 0.75, -0.5, 1.5, 1, 10);
  const Float4 lower_left = transform(p, {-1, -2, -4, 1}), upper_right = transform(p, {3, 6, -4, 1});
  EXPECT_NEAR(lower_left.x / lower_left.w, -1, 1e-6);
  EXPECT_NEAR(lower_left.y / lower_left.w, -1, 1e-6);
  EXPECT_NEAR(upper_right.x / upper_right.w, 1, 1e-6);
  EXPECT_NEAR(upper_right.y / upper_right.w, 1, 1e-6);
}

TEST(Matrix, OrthographicMapsItsBoxOntoTheCube) {
  const Mat4 p = orthographic(2, 6, -1, 3, 5, 9);
  expect_near(transform(p, {2, -1, -5, 1}), {-1, -1, -1, 1});
  expect_near(transform(p, {6, 3, -9, 1}), {1, 1, 1, 1});
}

TEST(Matrix, RotationTakesItsFrameToTheAxes) {
  const Mat4 r = rotation_into({0, 0, -1}, {0, 1, 0}, {1, 0, 0});
  expect_near(transform(r, {0, 0, -1, 1}), {1, 0, 0, 1});
  expect_near(transform(r, {1, 0, 0, 1}), {0, 0, 1, 1});
}

TEST(Matrix, MultiplyAppliesTheRightFactorFirst) {
  const Mat4 a = orthographic(0, 4, 0, 4, 0, 4), b = rotation_into({0, 1, 0}, {-1, 0, 0}, {0, 0, 1});
  const Float4 v{0.5f, 0.25f, -1, 1};
  expect_near(transform(multiply(a, b), v), transform(a, transform(b, v)));
}

TEST(Matrix, NarrowStretchesATileOverTheWholeImage) {
  const Mat4 p = perspective(-1, 1, -1, 1, 1, 10);
  const Mat4 upper_right = narrow(p, 0.5, 1, 0.5, 1);
  // The centre of the image is the tile's lower left corner; the corner of the image stays in the corner.
  const Float4 centre = transform(upper_right, {0, 0, -2, 1}), corner = transform(upper_right, {2, 2, -2, 1});
  EXPECT_NEAR(centre.x / centre.w, -1, 1e-6);
  EXPECT_NEAR(centre.y / centre.w, -1, 1e-6);
  EXPECT_NEAR(corner.x / corner.w, 1, 1e-6);
  EXPECT_NEAR(corner.y / corner.w, 1, 1e-6);
}

}  // namespace
}  // namespace copse
