#include "lib/runtime/camera_path.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

const Camera k_camera{.eye = {3, 2, 4}, .target = {1, 1, 1}, .fov = 0.5};

TEST(CameraPath, OrbitKeepsDistanceAndHeightAndComesBack) {
  const CameraPath path = CameraPath::orbit(k_camera);
  for (const double t : {0.0, 0.1, 0.35, 0.8}) {
    const Camera c = path.at(t);
    EXPECT_NEAR(distance(c.eye, c.target), distance(k_camera.eye, k_camera.target), 1e-12);
    EXPECT_DOUBLE_EQ(c.eye.y, 2);
    EXPECT_EQ(c.target, k_camera.target);
  }
  EXPECT_EQ(path.at(0).eye, k_camera.eye);
  EXPECT_NEAR(distance(path.at(1).eye, k_camera.eye), 0, 1e-12);
}

TEST(CameraPath, OrbitTurnsCounterClockwiseSeenFromAbove) {
  const Camera c = CameraPath::orbit({.eye = {1, 0, 0}, .target = {}}).at(0.25);
  EXPECT_NEAR(distance(c.eye, {0, 0, -1}), 0, 1e-12);  // +Y up: +X turns to -Z
}

TEST(CameraPath, OrbitFramesLoopAndOtherPathsReachTheirEnd) {
  EXPECT_DOUBLE_EQ(CameraPath::orbit(k_camera).moment(7, 8), 7.0 / 8);
  EXPECT_DOUBLE_EQ(CameraPath::linear(k_camera).moment(7, 8), 1);
  EXPECT_DOUBLE_EQ(CameraPath::linear(k_camera).moment(0, 1), 0);
  EXPECT_DOUBLE_EQ(CameraPath::still(k_camera).moment(0, 0), 0);
}

TEST(CameraPath, LinearStopsATenthBeforeTheTargetAndLooksAhead) {
  const CameraPath path = CameraPath::linear(k_camera);
  const Camera end = path.at(1);
  EXPECT_NEAR(distance(end.eye, k_camera.target), 0.1 * distance(k_camera.eye, k_camera.target), 1e-12);
  EXPECT_NEAR(distance(end.eye - end.target, k_camera.eye - k_camera.target), 0, 1e-12);
}

TEST(CameraPath, ZigzagGoesInThreeEqualLegsAndTurnsAtOnceByARightAngle) {
  const Camera start{.eye = {0, 2, 10}, .target = {0, 2, 0}};
  const CameraPath path = CameraPath::zigzag(start);
  const double leg = distance(path.at(0).eye, path.at(1.0 / 3).eye);
  EXPECT_NEAR(distance(path.at(1.0 / 3).eye, path.at(2.0 / 3).eye), leg, 1e-9);
  EXPECT_NEAR(distance(path.at(2.0 / 3).eye, path.at(1).eye), leg, 1e-9);
  EXPECT_NEAR(path.at(1).eye.z, 1, 1e-9) << "a tenth of the way is left";
  EXPECT_LT(path.at(1.0 / 3).eye.x, -1) << "to the left first";
  const auto sight = [&](double t) { return path.at(t).target - path.at(t).eye; };
  EXPECT_NEAR(dot(sight(0.333), sight(0.334)), 0, 1e-9);
  EXPECT_NEAR(length(cross(sight(0.2), path.at(0.3).eye - path.at(0.1).eye)), 0, 1e-9)
      << "looks where it goes";
  EXPECT_NEAR(length(sight(0.5)), 10, 1e-9);
}

Camera at(double x, double fov = 0.5) {
  return {.eye = {x, x * x, 5}, .target = {x, 0, 0}, .fov = fov};
}

TEST(CameraPath, PassesThroughEveryKeyAtItsTime) {
  const std::vector<PathKey> keys{{10, at(0)}, {11, at(1)}, {15, at(4, 0.9)}, {20, at(2)}};
  const auto path = CameraPath::through(keys);
  ASSERT_TRUE(path);
  for (const PathKey& key : keys) {
    const Camera c = path->at((key.time - 10) / 10);
    EXPECT_NEAR(distance(c.eye, key.camera.eye), 0, 1e-12);
    EXPECT_NEAR(distance(c.target, key.camera.target), 0, 1e-12);
    EXPECT_NEAR(c.fov, key.camera.fov, 1e-12);
  }
}

TEST(CameraPath, ReproducesAParabolaBetweenInnerKeys) {
  // The tangents are those of the parabola through three neighbours, so inner intervals are exact.
  const auto path = CameraPath::through({{0, at(0)}, {1, at(1)}, {3, at(3)}, {4, at(4)}});
  ASSERT_TRUE(path);
  EXPECT_NEAR(distance(path->at(0.5).eye, {2, 4, 5}), 0, 1e-12);
}

TEST(CameraPath, HasNoKinkAtAKey) {
  const auto path = CameraPath::through({{0, at(0)}, {1, at(3)}, {5, at(1)}, {6, at(6)}});
  ASSERT_TRUE(path);
  const double h = 1e-6, t = 1 / 6.0;
  const Double3 before = (path->at(t).eye - path->at(t - h).eye) / h;
  const Double3 after = (path->at(t + h).eye - path->at(t).eye) / h;
  EXPECT_NEAR(distance(before, after), 0, 1e-3 * length(before));
}

TEST(CameraPath, OneKeyStandsStill) {
  const auto path = CameraPath::through({{3, at(2)}});
  ASSERT_TRUE(path);
  EXPECT_EQ(path->at(0.7), at(2));
}

TEST(CameraPath, RefusesKeysOutOfOrderOrWithoutALineOfSight) {
  EXPECT_EQ(CameraPath::through({}).error().what, "the path has no keys");
  EXPECT_EQ(CameraPath::through({{0, at(0)}, {0, at(1)}}).error().what,
            "key 1 is not later than the one before");
  EXPECT_EQ(CameraPath::through({{0, {.eye = {1, 1, 1}, .target = {1, 1, 1}}}}).error().what,
            "key 0 has no line of sight");
}

}  // namespace
}  // namespace copse
