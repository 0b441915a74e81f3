#include "lib/runtime/camera.h"

#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace copse {
namespace {

constexpr double k_pi = std::numbers::pi;

// Where a point (absolute) falls on the image: -1 to 1, x to the right, y up.
Float2 project(const View& view, const Double3& p) {
  const Float3 relative = to_float(p - view.eye);
  const Float4 clip =
      transform(view.projection, transform(view.rotation, {relative.x, relative.y, relative.z, 1}));
  return {clip.x / clip.w, clip.y / clip.w};
}

TEST(Camera, FrameIsRightHandedWithBackTowardsTheEye) {
  const CameraFrame f = frame_of({.eye = {5, 0, 0}, .target = {0, 0, 0}});
  EXPECT_NEAR(distance(f.back, {1, 0, 0}), 0, 1e-15);
  EXPECT_NEAR(distance(f.up, {0, 1, 0}), 0, 1e-15);
  EXPECT_NEAR(distance(f.right, {0, 0, -1}), 0, 1e-15);
}

TEST(Camera, LookingStraightDownStillHasAFrame) {
  for (const double y : {3.0, -3.0}) {
    const CameraFrame f = frame_of({.eye = {0, y, 0}, .target = {0, 0, 0}});
    EXPECT_NEAR(length(f.right), 1, 1e-12);
    EXPECT_NEAR(length(f.up), 1, 1e-12);
    EXPECT_NEAR(dot(f.right, f.up), 0, 1e-12);
    EXPECT_NEAR(dot(f.right, f.back), 0, 1e-12);
  }
}

TEST(Camera, WithoutALineOfSightIsNotValid) {
  EXPECT_TRUE(is_valid({.eye = {0, 0, 1}, .target = {}}));
  EXPECT_FALSE(is_valid({.eye = {1, 2, 3}, .target = {1, 2, 3}}));
  EXPECT_FALSE(is_valid({.eye = {0, 0, 1}, .target = {}, .fov = 0}));
  EXPECT_FALSE(is_valid({.eye = {0, 0, 1}, .target = {}, .fov = k_pi}));
  EXPECT_FALSE(is_valid({.eye = {0, 0, std::nan("")}, .target = {}}));
  EXPECT_FALSE(is_valid({.eye = {1e308, 0, 1}, .target = {-1e308, 0, 0}}));
}

TEST(Camera, TheEdgeOfTheFieldOfViewIsTheEdgeOfTheImage) {
  const Camera camera{.eye = {0, 0, 10}, .target = {}, .fov = k_pi / 2};
  const View view = make_view(camera, 2.0, 0.1, 100);
  const Float2 corner = project(view, {20, 10, 0});
  EXPECT_NEAR(corner.x, 1, 1e-6);
  EXPECT_NEAR(corner.y, 1, 1e-6);
}

TEST(Camera, ATreeTenThousandKilometresAwayIsDrawnAsOneAtTheOrigin) {
  const Double3 far{1e7, 2e7, -3e7};
  const Camera here{.eye = {3, 4, 5}, .target = {0.5, 1, 0}, .fov = 0.7};
  Camera there = here;
  there.eye += far, there.target += far;
  const View a = make_view(here, 1.5, 0.1, 100), b = make_view(there, 1.5, 0.1, 100);
  const Float3 offset_a = a.offset_from_eye({}), offset_b = b.offset_from_eye(far);
  EXPECT_NEAR(offset_a.x, offset_b.x, 1e-8);
  EXPECT_NEAR(offset_a.y, offset_b.y, 1e-8);
  EXPECT_NEAR(offset_a.z, offset_b.z, 1e-8);
  for (std::size_t i = 0; i < 16; ++i) EXPECT_NEAR(a.rotation.m[i], b.rotation.m[i], 1e-7);
}

TEST(Camera, FrustumKeepsWhatIsOnTheImageAndNothingElse) {
  const Camera camera{.eye = {7, -2, 3}, .target = {1, 2, 0}, .fov = 0.8};
  const View view = make_view(camera, 1.7, 0.5, 20);
  const Frustum frustum = frustum_of(view);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> around(-25, 25);
  int inside = 0;
  for (int i = 0; i < 20000; ++i) {
    const Double3 p = camera.eye + Double3{around(random), around(random), around(random)};
    DoubleBox point;
    point.grow(p);
    const Double3 relative = p - camera.eye;
    const double depth = -dot(relative, view.frame.back);
    const double x = dot(relative, view.frame.right), y = dot(relative, view.frame.up);
    const double slack = std::min({depth - 0.5, 20 - depth, depth * view.tan_half_x - std::abs(x),
                                   depth * view.tan_half_y - std::abs(y)});
    if (std::abs(slack) < 1e-9) continue;
    EXPECT_EQ(classify(frustum, camera.eye, point) != Visibility::outside, slack > 0);
    inside += slack > 0;
  }
  EXPECT_GT(inside, 100);
}

TEST(Camera, ClassifyTellsInsideFromCrossingFromOutside) {
  const Camera camera{.eye = {0, 0, 10}, .target = {}, .fov = k_pi / 2};
  const Frustum frustum = frustum_of(make_view(camera, 1, 1, 100));
  const auto box = [](const Double3& c, double h) {
    return DoubleBox{c - Double3{h, h, h}, c + Double3{h, h, h}};
  };
  std::uint64_t tests = 0;
  EXPECT_EQ(classify(frustum, camera.eye, box({0, 0, 0}, 1), &tests), Visibility::inside);
  EXPECT_EQ(tests, 6u);
  EXPECT_EQ(classify(frustum, camera.eye, box({10, 0, 0}, 1)), Visibility::crossing);
  EXPECT_EQ(classify(frustum, camera.eye, box({0, 0, 20}, 1)), Visibility::outside);
  EXPECT_EQ(classify(frustum, camera.eye, DoubleBox{}), Visibility::outside);
  tests = 0;
  EXPECT_EQ(classify(frustum, camera.eye, box({-50, 0, 0}, 1), &tests), Visibility::outside);
  EXPECT_EQ(tests, 1u) << "the left plane alone decides";
}

TEST(Camera, FitTouchesTwoEdgesOfTheImageAndLeavesNothingOut) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<float> around(-1, 1);
  for (int round = 0; round < 50; ++round) {
    std::vector<Float3> points(40);
    for (Float3& p : points) p = {3 * around(random), 5 * around(random), around(random)};
    const Double3 origin{1e6, -1e6, 5};
    const double aspect = 0.5 + std::abs(around(random)) * 2;
    const auto camera = fit(points, origin, {around(random), 0.2, 1}, 0.6, aspect, 0);
    ASSERT_TRUE(camera);
    const View view = make_view(*camera, aspect, 0.01, 1000);
    double left = 9, right = -9, bottom = 9, top = -9;
    for (const Float3& p : points) {
      const Float2 at = project(view, origin + to_double(p));
      left = std::min<double>(left, at.x), right = std::max<double>(right, at.x);
      bottom = std::min<double>(bottom, at.y), top = std::max<double>(top, at.y);
    }
    EXPECT_GE(std::min(left, bottom), -1 - 1e-5);
    EXPECT_LE(std::max(right, top), 1 + 1e-5);
    const bool fills_x = left < -1 + 1e-5 && right > 1 - 1e-5;
    const bool fills_y = bottom < -1 + 1e-5 && top > 1 - 1e-5;
    EXPECT_TRUE(fills_x || fills_y);
  }
}

TEST(Camera, FitKeepsTheMarginThatWasAskedFor) {
  const std::vector<Float3> points{{-1, 0, 0}, {1, 0, 0}};
  const auto camera = fit(points, {}, {0, 0, 1}, k_pi / 2, 1, 0.25);
  ASSERT_TRUE(camera);
  EXPECT_NEAR(camera->eye.z, 1.25, 1e-12);
}

TEST(Camera, FitOfOnePointOrOfNoneIsDefined) {
  const std::vector<Float3> one{{1, 2, 3}};
  const auto camera = fit(one, {}, {0, 0, 1}, 0.6, 1, 0.1);
  ASSERT_TRUE(camera);
  EXPECT_TRUE(is_valid(*camera));
  EXPECT_FALSE(fit({}, {}, {0, 0, 1}, 0.6, 1, 0.1));
  const std::vector<Float3> none{{NAN, 0, 0}};
  EXPECT_FALSE(fit(none, {}, {0, 0, 1}, 0.6, 1, 0.1));
}

}  // namespace
}  // namespace copse
