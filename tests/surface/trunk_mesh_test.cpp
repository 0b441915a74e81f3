#include "lib/analysis/surface/trunk_mesh.h"

#include "lib/analysis/surface/surfaces.h"
#include "tests/trunk/tube_maker.h"

#include <set>

#include <gtest/gtest.h>

namespace copse {
namespace {

TubeShape post(const Double3& from, const Double3& to, double radius, int sides = 6) {
  TubeShape shape;
  shape.axis = axis_between(from, to, 3);
  shape.radius = taper_between(radius, radius, 3);
  shape.sides = sides;
  return shape;
}

TEST(TrunkMesh, ClosesSeamsAndFlatShadedFaces) {
  for (const bool split : {false, true}) {
    TubeMaker maker;
    TubeShape shape = post({0, 0, 0}, {0, 4, 0}, 1);
    shape.seam = true;
    shape.split = split;
    maker.add(shape);
    const TrunkMesh trunk = make_trunk_mesh(maker.mesh, all_trunk(maker.mesh));
    EXPECT_EQ(trunk.positions.size(), 18u);
    EXPECT_EQ(make_surfaces(trunk).size(), 1u);
    EXPECT_EQ(trunk.piece.back(), split ? 23u : 0u);
  }
}

TEST(TrunkMesh, KeepsTubesApartThatShareAPointOrLieAlongAnEdge) {
  TubeMaker maker;
  maker.add(post({0, 0, 0}, {0, 4, 0}, 1, 4));
  maker.add(post({2, 0, 0}, {2, 4, 0}, 1, 4));  // the corners at x = 1 coincide, ring by ring
  const TrunkMesh trunk = make_trunk_mesh(maker.mesh, all_trunk(maker.mesh));
  EXPECT_EQ(trunk.positions.size(), 24u);
  EXPECT_EQ(make_surfaces(trunk).size(), 2u);
}

TEST(TrunkMesh, SewsTubesThatAreLaidEndToEnd) {
  TubeMaker maker;
  maker.add(post({0, 0, 0}, {0, 4, 0}, 1));
  maker.add(post({0, 4, 0}, {0, 8, 0}, 1));
  const TrunkMesh trunk = make_trunk_mesh(maker.mesh, all_trunk(maker.mesh));
  EXPECT_EQ(trunk.positions.size(), 30u);
  EXPECT_EQ(make_surfaces(trunk).size(), 1u);
  EXPECT_EQ(std::set(trunk.piece.begin(), trunk.piece.end()).size(), 2u);
}

TEST(TrunkMesh, SewsABranchToTheInnerRingThatItStartsOn) {
  TubeMaker maker;
  maker.add(post({0, 0, 0}, {0, 4, 0}, 1));
  maker.add(post({0, 2, 0}, {0, 9, 0}, 1));  // its first ring is the middle ring of the other
  const TrunkMesh trunk = make_trunk_mesh(maker.mesh, all_trunk(maker.mesh));
  EXPECT_EQ(trunk.positions.size(), 30u);  // the second tube's other rings are its own
  EXPECT_EQ(make_surfaces(trunk).size(), 1u);
}

TEST(TrunkMesh, LeavesOutTrianglesThatWeldingMakesDegenerateAndLeaves) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {5, 5, 5}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {1, 2, 4}, {2, 2, 1}};
  const TrunkMesh trunk = make_trunk_mesh(mesh, std::vector<std::uint8_t>{1, 1, 0, 1});
  EXPECT_EQ(trunk.source, (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(trunk.positions.size(), 3u);
}

TEST(TrunkMesh, ObeysATolerance) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1.05, 0, 0}, {0, 1.05, 0}, {2, 2, 0}};
  mesh.triangles = {{0, 1, 2}, {3, 5, 4}};
  const std::vector<std::uint8_t> both{1, 1};
  EXPECT_EQ(make_trunk_mesh(mesh, both, 0.04).positions.size(), 6u);
  EXPECT_EQ(make_trunk_mesh(mesh, both, 0.06).positions.size(), 4u);
}

TEST(TrunkMesh, OfNothingIsEmpty) {
  EXPECT_TRUE(make_trunk_mesh(Mesh{}, {}).triangles.empty());
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_TRUE(make_trunk_mesh(mesh, std::vector<std::uint8_t>{0}).positions.empty());
}

TEST(TrunkMesh, VerticesThatAreNearInTheMiddleOfASurfaceStayApart) {
  TubeMaker maker;
  TubeShape shape;
  shape.axis = axis_between({0, 0, 0}, {0, 4, 0}, 5);
  shape.radius = taper_between(0.5, 0.5, 5);
  shape.sides = 8;
  maker.add(shape);
  // Two rings meet almost, in one point.
  Double3 &low = maker.mesh.positions[8], &high = maker.mesh.positions[16];
  ASSERT_NEAR(distance(low, high), 1, 1e-9);
  high = low + Double3{0, 1e-5, 0};
  EXPECT_EQ(make_trunk_mesh(maker.mesh, all_trunk(maker.mesh)).positions.size(), 40u);
}

}  // namespace
}  // namespace copse
