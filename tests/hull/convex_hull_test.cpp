#include "lib/analysis/hull/convex_hull.h"

#include "lib/formats/random.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace copse {
namespace {

using Points = std::vector<Double3>;

ConvexHull hull_of(const Points& points) {
  return convex_hull(make_point_cloud(points).value());
}

double outside_of(const ConvexHull& hull, const Double3& p) {
  double worst = 0;
  for (const auto& f : hull.faces) {
    const Double3& a = hull.vertices[f[0]];
    const Double3 n = normalized(cross(hull.vertices[f[1]] - a, hull.vertices[f[2]] - a));
    worst = std::max(worst, dot(n, p - a));
  }
  return worst;
}

Points random_points(std::uint64_t seed, int n, const Double3& size) {
  Random random(seed);
  Points points;
  for (int i = 0; i < n; ++i) {
    points.push_back({size.x * random.uniform(), size.y * random.uniform(), size.z * random.uniform()});
  }
  return points;
}

TEST(ConvexHull, OfACubeHasItsCornersFacesAndMeasures) {
  Points points;
  for (int i = 0; i < 8; ++i) points.push_back({i & 1 ? 3. : 2., i & 2 ? 5. : 4., i & 4 ? 7. : 6.});
  const ConvexHull hull = hull_of(points);
  EXPECT_EQ(hull.dimension, 3);
  EXPECT_EQ(hull.vertices.size(), 8u);
  EXPECT_EQ(hull.faces.size(), 12u);
  EXPECT_EQ(hull.edges.size(), 18u);
  EXPECT_NEAR(hull.frame.volume_out(hull.volume), 1, 1e-15);
  EXPECT_NEAR(hull.area * hull.frame.scale * hull.frame.scale, 6, 1e-15);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(hull.frame.out(hull.vertices[i]), points[hull.indices[i]]);
}

TEST(ConvexHull, HoldsEveryPointAndItsEdgesJoinTheirFaces) {
  for (const Double3 size :
       {Double3{1, 1, 1}, Double3{1, 1, 1e-6}, Double3{1, 1e-6, 1e-6}, Double3{1, 1, 1e-12}}) {
    const Points points = random_points(7, 500, size);
    const PointCloud cloud = make_point_cloud(points).value();
    const ConvexHull hull = convex_hull(cloud);
    ASSERT_EQ(hull.dimension, 3);
    for (const Double3& p : cloud.points) EXPECT_LE(outside_of(hull, p), 1e-15);
    ASSERT_EQ(hull.vertices.size() + hull.faces.size(), hull.edges.size() + 2);
    for (const HullEdge& e : hull.edges) {
      EXPECT_LT(e.a, e.b);
      EXPECT_NE(e.left, e.right);
      for (const std::uint32_t f : {e.left, e.right}) {
        EXPECT_EQ(std::count(hull.faces[f].begin(), hull.faces[f].end(), e.a), 1);
        EXPECT_EQ(std::count(hull.faces[f].begin(), hull.faces[f].end(), e.b), 1);
      }
    }
  }
}

TEST(ConvexHull, FindsTheDimensionAndAFrameOfFlatPoints) {
  EXPECT_EQ(hull_of({{4, 5, 6}}).dimension, 0);
  EXPECT_EQ(hull_of(Points(100, {1e9, 5, 6})).vertices.size(), 1u);
  Points line, circle;
  for (int i = 0; i < 50; ++i) line.push_back(Double3{0.1, 0.2, 0.3} * double(i));
  const ConvexHull l = hull_of(line);
  EXPECT_EQ(l.dimension, 1);
  ASSERT_EQ(l.vertices.size(), 2u);
  EXPECT_EQ(l.frame.out(l.vertices[1]), line.back());
  EXPECT_NEAR(std::abs(dot(l.axes[0], normalized({1, 2, 3}))), 1, 1e-15);
  const Double3 u = normalized({1, 2, 3}), v = normalized(cross(u, {0, 0, 1}));
  for (int i = 0; i < 64; ++i) {
    const double a = i * std::numbers::pi / 32;
    circle.push_back(u * std::cos(a) + v * std::sin(a));
    circle.push_back((u * std::cos(a) + v * std::sin(a)) * 0.9);
  }
  const ConvexHull c = hull_of(circle);
  EXPECT_EQ(c.dimension, 2);
  EXPECT_EQ(c.vertices.size(), 64u);
  EXPECT_EQ(c.edges.size(), 64u);
  EXPECT_NEAR(std::abs(dot(c.axes[2], cross(u, v))), 1, 1e-14);
  for (const ConvexHull& h : {l, c}) {
    EXPECT_NEAR(length(cross(h.axes[0], h.axes[1]) - h.axes[2]), 0, 1e-15);
    EXPECT_NEAR(length(h.axes[1]), 1, 1e-15);
  }
}

// Lengths cancel: what rounding leaves of a needle's volume may be a million times what it has.
TEST(ConvexHull, OfATiltedNeedleTheLeastVolumeIsNoMoreThanItsLengthAndThicknessAllow) {
  const Double3 u = normalized({1, 2, 3}), v = normalized(cross(u, {0, 0, 1})), w = cross(u, v);
  for (const double thin : {1e-2, 1e-6, 1e-9, 1e-12}) {
    Random random(3);
    Points needle;
    for (int i = 0; i < 200; ++i)
      needle.push_back(u * random.around(0, 1) + (v * random.around(0, 1) + w * random.around(0, 1)) * thin);
    const ConvexHull hull = hull_of(needle);
    const double least = hull.frame.volume_out(hull.least_volume);
    EXPECT_LE(least, 2.001 * (2 * thin + 4e-16) * (2 * thin + 4e-16)) << thin;
    if (thin >= 1e-6) {
      EXPECT_GE(hull.least_volume, 0.99 * hull.volume) << thin;
    }
  }
}

TEST(ConvexHull, NearlyFlatPointsAreStillSpace) {
  Points points = random_points(3, 200, {1, 1, 0});
  for (std::size_t i = 0; i < points.size(); ++i) points[i].z = 1e-13 * double(i % 7);
  EXPECT_EQ(hull_of(points).dimension, 3);
}

TEST(ConvexHull, DoesNotDependOnTheOrderOrRepetitionOfThePoints) {
  Points points = random_points(5, 3000, {3, 2, 1});
  for (int i = 0; i < 1000; ++i) points.push_back({i % 10 * .3, i / 10 % 10 * .2, i / 100 * .1});  // coplanar
  const ConvexHull hull = hull_of(points);
  Random random(1);
  for (int round = 0; round < 3; ++round) {
    points.push_back(points[17 * round]);
    random.shuffle(std::span(points));
    const ConvexHull other = hull_of(points);
    EXPECT_EQ(other.vertices, hull.vertices);
    EXPECT_EQ(other.faces, hull.faces);
    EXPECT_EQ(other.edges, hull.edges);
    EXPECT_EQ(other.boundary, hull.boundary);
    EXPECT_EQ(other.volume, hull.volume);
    EXPECT_EQ(other.loss, hull.loss);
  }
}

TEST(ConvexHull, AKernelIsOfTheCornersThatReachFarthestInAnyOrderAndRepetition) {
  Points bowl = random_points(11, 20'000, {2, 2, 0});  // all are corners, and the rim is sharp
  for (Double3& p : bowl) p.z = 0.2 * ((p.x - 1) * (p.x - 1) + (p.y - 1) * (p.y - 1));
  const PointCloud cloud = make_point_cloud(bowl).value();
  const ConvexHull hull = convex_hull(cloud, {.max_corners = 500});
  EXPECT_EQ(hull.vertices.size(), 500u);
  EXPECT_LT(hull.loss, 0.02);
  double worst = 0;
  for (std::size_t i = 0; i < cloud.points.size(); i += 9)
    worst = std::max(worst, outside_of(hull, cloud.points[i]));
  EXPECT_LE(worst, hull.loss);
  EXPECT_LT(worst, 5e-3);
  Random random(1);
  bowl.insert(bowl.end(), bowl.begin(), bowl.begin() + 5000);
  random.shuffle(std::span(bowl));
  const ConvexHull other = convex_hull(make_point_cloud(bowl).value(), {.max_corners = 500});
  EXPECT_EQ(other.vertices, hull.vertices);
  EXPECT_EQ(other.boundary, hull.boundary);
  EXPECT_EQ(other.loss, hull.loss);
}

// A hull that takes what lies in a facet's plane for outside it cuts a lid anew for each of its corners.
TEST(ConvexHull, OfAConeOfManySidesIsFoundAtOnce) {
  constexpr int k_sides = 9000;
  Points cone{{0, 0, 1}};
  for (int i = 0; i < k_sides; ++i) {
    const double a = 2 * std::numbers::pi * i / k_sides;
    cone.push_back({std::cos(a), std::sin(a), 0});
  }
  const ConvexHull hull = hull_of(cone);
  EXPECT_EQ(hull.vertices.size(), cone.size());
  EXPECT_EQ(hull.faces.size(), 2u * k_sides - 2u);
  EXPECT_NEAR(hull.frame.volume_out(hull.volume), std::numbers::pi / 3, 1e-5);
}

// Other blocks of memory must not give another hull.
TEST(ConvexHull, DoesNotDependOnWhereInMemoryItIsBuilt) {
  Points torus;
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < 12; ++j) {
      const double a = 2 * std::numbers::pi * i / 20, b = 2 * std::numbers::pi * j / 12,
                   r = 0.5 + 0.2 * std::cos(b);
      torus.push_back({r * std::cos(a), r * std::sin(a), 0.2 * std::sin(b)});
    }
  }
  const ConvexHull first = hull_of(torus);
  Random random(5);
  std::vector<std::vector<char>> blocks;
  for (int i = 0; i < 60; ++i) {
    for (int k = 0; k < 20; ++k) blocks.emplace_back(1 + random.below(60'000));
    for (int k = 0; k < 12; ++k)
      std::swap(blocks[random.below(blocks.size())], blocks.back()), blocks.pop_back();
    const ConvexHull again = hull_of(torus);
    ASSERT_EQ(first.vertices, again.vertices) << i;
    ASSERT_EQ(first.faces, again.faces) << i;
  }
}

TEST(ConvexHull, PointsOnFacetsAndEdgesAreNoCorners) {
  Points grid, prism;
  for (int i = 0; i < 216; ++i) {
    grid.push_back({double(i % 6), double(i / 6 % 6), double(i / 36)});
  }
  for (int i = 0; i < 2; ++i) {  // a prism over a hexagon whose middle and edges hold points too
    for (const auto& [x, y] : {std::pair{2., 0.},
                               {4., 0.},
                               {6., 2.},
                               {4., 4.},
                               {2., 4.},
                               {0., 2.},
                               {3., 0.},
                               {3., 4.},
                               {1., 1.},
                               {3., 2.},
                               {5., 3.}}) {
      prism.push_back({x, y, double(i)});
    }
  }
  EXPECT_EQ(hull_of(grid).vertices.size(), 8u);
  EXPECT_EQ(hull_of(grid).faces.size(), 12u);
  EXPECT_EQ(hull_of(prism).vertices.size(), 12u);
  EXPECT_EQ(hull_of(prism).faces.size(), 4u + 4u + 12u);
}

TEST(ConvexHull, TheInnerBallLiesInTheHull) {
  Points cube, needle;
  Random random(3);
  for (int i = 0; i < 8; ++i) cube.push_back({double(i & 1), double(i >> 1 & 1), double(i >> 2)});
  EXPECT_NEAR(inner_radius(hull_of(cube)) * hull_of(cube).frame.scale, 0.5, 1e-12);
  for (const double thin : {1e-2, 1e-6, 1e-12}) {
    needle.clear();
    const Double3 u = normalized({1, 2, 3}), v = normalized(cross(u, {0, 0, 1})), w = cross(u, v);
    for (int i = 0; i < 60; ++i)
      needle.push_back(u * random.around(0, 1) + (v * random.around(0, 1) + w * random.around(0, 1)) * thin);
    const ConvexHull hull = hull_of(needle);
    const double r = inner_radius(hull) * hull.frame.scale;
    EXPECT_LE(r, thin) << thin;
    if (thin >= 1e-6) {
      EXPECT_GE(r, 0.2 * thin) << thin;
    }
  }
  EXPECT_EQ(inner_radius(hull_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}})), 0);
}

TEST(ConvexHull, WhenTheTimeIsUpItIsOfFewerCornersAndKnowsWhatIsOutsideThem) {
  Random random(9);
  Points points;
  while (points.size() < 20'000) {
    const Double3 p{random.around(0, 1), random.around(0, 1), random.around(0, 1)};
    if (length(p) <= 1 && length(p) > 0.1) points.push_back(normalized(p));
  }
  HullOptions late;
  late.deadline = Deadline::after(0);
  const ConvexHull hull = convex_hull(make_point_cloud(points).value(), late);
  EXPECT_LE(hull.vertices.size(), k_least_corners);
  EXPECT_GT(hull.vertices.size(), k_least_corners / 2);
  EXPECT_GT(hull.loss, 0);
  EXPECT_EQ(hull.boundary.size(), points.size());
  EXPECT_EQ(hull.indices.size(), hull.vertices.size());
}

}  // namespace
}  // namespace copse
