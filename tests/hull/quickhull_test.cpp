#include "lib/analysis/hull/quickhull.h"

#include "lib/analysis/hull/exact_sign.h"
#include "lib/analysis/hull/point_cloud.h"
#include "tests/volumes/point_sets.h"

#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

namespace copse {
namespace {

// Closed, every edge once each way, no point outside any face; exact.
void expect_hull(const HullTriangles& hull, const Points& points, const std::string& name) {
  ASSERT_GE(hull.faces.size(), 4u) << name;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> edges;
  for (std::uint32_t f = 0; f < hull.faces.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i)
      ASSERT_TRUE(edges.insert({{hull.faces[f][i], hull.faces[f][(i + 1) % 3]}, f}).second) << name;
  }
  std::set<std::uint32_t> corners;
  for (std::uint32_t f = 0; f < hull.faces.size(); ++f) {
    const auto& [a, b, c] = hull.faces[f];
    for (std::size_t i = 0; i < 3; ++i) {
      const auto across = edges.find({hull.faces[f][(i + 1) % 3], hull.faces[f][i]});
      ASSERT_NE(across, edges.end()) << name;
      ASSERT_EQ(across->second, hull.neighbours[f][i]) << name;
    }
    ASSERT_FALSE(exactly_collinear(points[a], points[b], points[c])) << name;
    for (const Double3& p : points) ASSERT_LE(exact_side(points[a], points[b], points[c], p), 0) << name;
    corners.insert(hull.faces[f].begin(), hull.faces[f].end());
  }
  EXPECT_EQ(hull.faces.size(), 2 * corners.size() - 4) << name;
}

Points cone(int n) {
  Points p = circle(n);
  p.push_back({0, 0, 1});
  return p;
}

Points drum(int n) {
  Points p = circle(n);
  for (int i = 0; i < n; ++i) p.push_back(p[i] + Double3{0, 0, 1});
  return p;
}

TEST(Quickhull, ClosesRoundAllPointsAndEveryTriangleHasAnArea) {
  for (const auto& [name, points] : degenerate_battery()) {
    const PointCloud cloud = make_point_cloud(points).value();
    const HullTriangles hull = quickhull(cloud.points);
    if (!hull.faces.empty()) expect_hull(hull, cloud.points, name);
  }
  for (const Points& points :
       {cone(300), drum(200), turned(drum(200), {1, 2, 3}, {0, 1, 1}), even_sphere(400)})
    expect_hull(quickhull(points), points, "round");
}

TEST(Quickhull, LatticesWithPointsInEveryFacetAndEdge) {
  Points cube, tilted;
  for (int i = 0; i < 125; ++i) {
    const double x = i % 5, y = i / 5 % 5, z = i / 25;
    cube.push_back({x, y, z});
    tilted.push_back(Double3{x + 2 * y, z - y, 3 * x - z + y} / 16.0);
  }
  Random random(3);
  for (Points points : {cube, tilted}) {
    for (int round = 0; round < 20; ++round) {
      random.shuffle(std::span(points));
      expect_hull(quickhull(points), points, "lattice");
    }
  }
}

TEST(Quickhull, IsEmptyOfWhatLiesInAPlane) {
  EXPECT_TRUE(quickhull({}).faces.empty());
  EXPECT_TRUE(quickhull(Points(10, {1, 2, 3})).faces.empty());
  EXPECT_TRUE(quickhull(line(50, {0.5, 0.25, 0.125})).faces.empty());
  EXPECT_TRUE(quickhull(grid(9, 7, {1, 0.5, 0.25}, {0, 0.5, -1})).faces.empty());
}

TEST(Quickhull, FindsTheOnePointThatIsOutOfThePlaneByARounding) {
  Points points = grid(20, 20);
  points.push_back({7.25, 3.5, 5e-324});
  expect_hull(quickhull(points), points, "grid and a point");
}

}  // namespace
}  // namespace copse
