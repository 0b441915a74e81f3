#include "lib/analysis/skeleton/flow_skeleton.h"

#include "lib/analysis/surface/components.h"
#include "tests/trunk/welded_meshes.h"

#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

void expect_sound(const Surface& s, const CurveSkeleton& k) {
  ASSERT_FALSE(k.points.empty());
  UnionFind sets(k.points.size());
  for (const auto& [a, b] : k.edges) sets.unite(a, b);
  for (std::uint32_t n = 0; n < k.points.size(); ++n) {
    EXPECT_EQ(sets.find(n), 0u);
    EXPECT_TRUE(is_finite(k.points[n]));
    EXPECT_GE(k.radii[n], 0);
  }
  ASSERT_EQ(k.node_of.size(), s.positions.size());
  for (const auto n : k.node_of) EXPECT_LT(n, k.points.size());
}

TEST(FlowSkeleton, ClosesAWideHoleByAVertexInItsMiddle) {
  std::vector<Double3> axis;
  for (int i = 0; i <= 8; ++i) axis.push_back({0, 0.5 * i, 0});
  const Surface s = surface_of(tube(axis, std::vector<double>(9, 0.5), 200, false));
  const CurveSkeleton k = flow_skeleton(s);
  expect_sound(s, k);
  for (const Double3& p : k.points) EXPECT_LT(std::hypot(p.x, p.z), 0.1);
}

TEST(FlowSkeleton, ClosesAnOpenTubeAndLiesOnItsAxis) {
  std::vector<Double3> axis;
  std::vector<double> radii;
  for (int i = 0; i <= 20; ++i) axis.push_back({3, 0.5 * i, 4}), radii.push_back(0.5);
  const Surface s = surface_of(tube(axis, radii, 8, false));
  const CurveSkeleton k = flow_skeleton(s);
  expect_sound(s, k);
  for (std::size_t n = 0; n < k.points.size(); ++n) {
    EXPECT_NEAR(k.points[n].x, 3, 0.15);
    EXPECT_NEAR(k.points[n].z, 4, 0.15);
  }
}

TEST(FlowSkeleton, RepairsWhatIsTurnedOverAndTorn) {
  TrunkMesh mesh =
      shuffled(smooth_cells(std::vector<Cell>{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 3, 0}}, 2), 2);
  mesh.triangles.erase(mesh.triangles.begin() + 10, mesh.triangles.begin() + 14);
  mesh.triangles.push_back({0, 5, 9});  // a flap
  const Surface s = surface_of(mesh);
  expect_sound(s, flow_skeleton(s));
}

TEST(FlowSkeleton, OfWhatEnclosesNothingIsEmpty) {
  const TrunkMesh flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}, {0, 1}, {0, 0}};
  EXPECT_TRUE(flow_skeleton(surface_of(flat)).points.empty());
  EXPECT_TRUE(flow_skeleton(Surface{}).points.empty());
}

TEST(FlowSkeleton, OfSliversIsSoundOrEmptyAndSoonThere) {
  for (double thick = 1; thick > 1e-17; thick /= 10) {
    TrunkMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, thick, 0}, {0.5, 0, thick}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    const Surface s = make_surface(mesh, first_component(mesh));
    const CurveSkeleton k = flow_skeleton(s);
    if (!k.points.empty()) expect_sound(s, k);
  }
}

TEST(FlowSkeleton, OfAnythingIsSoundOrEmpty) {
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    const TrunkMesh soup = random_soup(9, 20, seed);
    const Surface s = make_surface(soup, first_component(soup));
    const CurveSkeleton k = flow_skeleton(s);
    if (!k.points.empty()) expect_sound(s, k);
  }
}

}  // namespace
}  // namespace copse
