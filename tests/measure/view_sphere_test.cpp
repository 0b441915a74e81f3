#include "lib/analysis/measure/view_sphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(ViewSphere, HasTheNumbersOfASubdividedIcosahedron) {
  for (int n = 0; n < 4; ++n) {
    const ViewSphere s = view_sphere(n);
    EXPECT_EQ(s.directions.size(), 10u * (1u << (2 * n)) + 2);
    EXPECT_EQ(s.triangles.size(), 20u << (2 * n));
  }
}

TEST(ViewSphere, FindsTheFewestSubdivisionsWithEnoughViews) {
  EXPECT_EQ(subdivisions_for(0), 0);
  EXPECT_EQ(subdivisions_for(12), 0);
  EXPECT_EQ(subdivisions_for(13), 1);
  EXPECT_EQ(subdivisions_for(42), 1);
  EXPECT_EQ(subdivisions_for(43), 2);
}

TEST(ViewSphere, HoldsTheOppositeOfEveryDirection) {
  const ViewSphere s = view_sphere(2);
  for (const Double3& d : s.directions) {
    EXPECT_NEAR(length(d), 1, 1e-15);
    EXPECT_TRUE(std::any_of(s.directions.begin(), s.directions.end(),
                            [&](const Double3& e) { return distance(d, -e) < 1e-12; }));
  }
}

TEST(ViewSphere, TrianglesFaceOutwardAndCoverTheSphereOnce) {
  const ViewSphere s = view_sphere(1);
  double solid = 0;  // Van Oosterom and Strackee
  for (const auto& [i, j, k] : s.triangles) {
    const Double3 &a = s.directions[i], &b = s.directions[j], &c = s.directions[k];
    solid += 2 * std::atan2(dot(a, cross(b, c)), 1 + dot(a, b) + dot(b, c) + dot(c, a));
  }
  EXPECT_NEAR(solid, 4 * std::numbers::pi, 1e-9);
}

TEST(ViewSphere, FramesTheSphereFromEveryDirection) {
  for (const Double3& d : view_sphere(1).directions) {
    const OrthographicView v = view_of_sphere({1, 2, 3}, 5, d, 100);
    EXPECT_NEAR(dot(v.right, v.up), 0, 1e-12);
    EXPECT_NEAR(dot(cross(v.right, v.up), v.toward), 1, 1e-12) << "right-handed";
    EXPECT_NEAR(v.project(Double3{1, 2, 3} + v.right * 5).x, 100, 1e-9);
    EXPECT_NEAR(v.project(Double3{1, 2, 3} + v.up * 5).y, 0, 1e-9);
  }
  EXPECT_GT(view_of_sphere({}, 0, {0, 0, 0}, 8).pixel, 0) << "nothing to see is no reason for a NaN";
}

}  // namespace
}  // namespace copse
