#include "lib/analysis/rings/hole_filling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace copse {
namespace {

std::vector<Double3> polygon(int k) {
  std::vector<Double3> points;
  for (int i = 0; i < k; ++i) {
    const double a = 2 * std::numbers::pi * i / k;
    points.push_back({std::cos(a), std::sin(a), 0});
  }
  return points;
}

double area(const std::vector<Double3>& p, const std::vector<Triangle>& triangles) {
  double sum = 0;
  for (const Triangle& t : triangles) sum += length(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]])) / 2;
  return sum;
}

TEST(HoleFilling, CoversAConvexPolygonOnce) {
  for (const int k : {3, 4, 7, 20}) {
    const std::vector<Double3> p = polygon(k);
    std::vector<HoleCorner> corners;
    for (int i = 0; i < k; ++i) corners.push_back({static_cast<std::uint32_t>(i), k_none});
    const std::vector<Triangle> triangles = fill_polygon(p, corners);
    EXPECT_EQ(triangles.size(), static_cast<std::size_t>(k - 2));
    EXPECT_NEAR(area(p, triangles), k * std::sin(2 * std::numbers::pi / k) / 2, 1e-12) << k;
  }
  EXPECT_TRUE(fill_polygon({}, {{0, k_none}, {1, k_none}}).empty());
}

TEST(HoleFilling, PutsNoTriangleBetweenTwoSidesOfOneRingWhereThereIsAnotherWay) {
  const std::vector<Double3> p = polygon(4);
  const std::vector<Triangle> triangles = fill_polygon(p, {{0, 1}, {1, 1}, {2, k_none}, {3, k_none}});
  for (const Triangle& t : triangles) EXPECT_EQ(std::ranges::count(t, 1u), 1);
}

TEST(HoleFilling, AStripRunsBetweenTheSidesOnTheRingAndTheOthers) {
  const std::vector<Double3> p = polygon(6);
  const std::vector<std::uint32_t> corners{0, 1, 2, 3, 4, 5};
  const std::vector<std::uint8_t> on{1, 1, 0, 0, 0, 0};  // corners 0, 1, 2 against 3, 4, 5
  const std::vector<Triangle> strip = strip_across(p, corners, on);
  ASSERT_EQ(strip.size(), 4u);
  for (const Triangle& t : strip) {
    const auto near = std::ranges::count_if(t, [](std::uint32_t v) { return v < 3; });
    EXPECT_TRUE(near == 1 || near == 2);
  }
  EXPECT_NEAR(area(p, strip), 6 * std::sin(std::numbers::pi / 3) / 2, 1e-12);
}

TEST(HoleFilling, ThereIsNoStripBetweenSidesThatDoNotFollowOneAnother) {
  const std::vector<Double3> p = polygon(6);
  const std::vector<std::uint32_t> corners{0, 1, 2, 3, 4, 5};
  EXPECT_TRUE(strip_across(p, corners, std::vector<std::uint8_t>{1, 0, 0, 1, 0, 0}).empty());
  EXPECT_TRUE(strip_across(p, corners, std::vector<std::uint8_t>{1, 1, 1, 1, 1, 1}).empty());
  EXPECT_TRUE(strip_across(p, corners, std::vector<std::uint8_t>{0, 0, 0, 0, 0, 0}).empty());
}

}  // namespace
}  // namespace copse
