#include "lib/analysis/skeleton/level_skeleton.h"

#include "lib/analysis/surface/components.h"
#include "tests/trunk/welded_meshes.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

CurveSkeleton skeleton_of(const Surface& s) {
  const Lists of = triangles_of_vertices(s);
  return level_skeleton(s, of, lowest_end(s, of));
}

void expect_connected(const CurveSkeleton& k) {
  UnionFind sets(k.points.size());
  for (const auto& [a, b] : k.edges) sets.unite(a, b);
  for (std::uint32_t n = 0; n < k.points.size(); ++n) EXPECT_EQ(sets.find(n), 0u);
}

TEST(LowestEnd, IsTheWholeLowBorder) {
  const Double3 axis[] = {{0, 0, 0}, {0.2, 1, 0}, {0, 2, 0}};  // leans, so the border is not level
  const double radii[] = {1, 1, 1};
  const Surface s = surface_of(tube(axis, radii, 6, false));
  EXPECT_EQ(lowest_end(s, triangles_of_vertices(s)), (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5}));
}

TEST(LowestEnd, IsTheWholeLevelFoot) {
  const Double3 axis[] = {{0, 0, 0}, {0, 1, 0}};
  const double radii[] = {1, 1};
  const Surface s = surface_of(tube(axis, radii, 6, true));
  EXPECT_EQ(lowest_end(s, triangles_of_vertices(s)).size(), 7u);
}

TEST(LevelSkeleton, OfATubeIsItsAxis) {
  const Double3 axis[] = {{0, 0, 0}, {0, 4, 0}, {0, 8, 0}};
  const double radii[] = {1, 1, 1};
  const Surface s = surface_of(tube(axis, radii, 16, false));
  const CurveSkeleton k = skeleton_of(s);
  EXPECT_EQ(k.edges.size() + 1, k.points.size());
  for (std::uint32_t n = 0; n < k.points.size(); ++n) {
    if (k.points[n].y < 0.1 || k.points[n].y > 7.9) continue;  // half a slice at the ends
    EXPECT_NEAR(k.points[n].x, 0, 0.01);
    EXPECT_NEAR(k.points[n].z, 0, 0.01);
    EXPECT_NEAR(k.radii[n], 1, 0.02);
  }
  EXPECT_LT(k.points[k.base].y, 0.1);
}

TEST(LevelSkeleton, OfAForkHasThreeEnds) {
  const Surface s = surface_of(fork_tree({.depth = 1}).mesh);
  const CurveSkeleton k = skeleton_of(s);
  std::vector<int> degree(k.points.size(), 0);
  for (const auto& [a, b] : k.edges) ++degree[a], ++degree[b];
  EXPECT_EQ(std::ranges::count(degree, 1), 3);
  expect_connected(k);
}

TEST(LevelSkeleton, OfATorusIsACycle) {
  const Surface s = surface_of(torus(40, 10, 5, 1));
  const CurveSkeleton k = skeleton_of(s);
  EXPECT_EQ(k.edges.size(), k.points.size());
  expect_connected(k);
}

TEST(LevelSkeleton, OfAnythingIsConnectedAndFinite) {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    TrunkMesh soup = random_soup(10, 30, seed);
    const Surface s = make_surface(soup, first_component(soup));
    const CurveSkeleton k = skeleton_of(s);
    expect_connected(k);
    for (const Double3& p : k.points) EXPECT_TRUE(is_finite(p));
    for (const auto n : k.node_of) EXPECT_LT(n, k.points.size());
  }
}

}  // namespace
}  // namespace copse
