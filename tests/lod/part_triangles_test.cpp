#include "lib/formats/levels/part_triangles.h"

#include "tests/lod/tube_tree.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(PartTriangles, KeepsEveryTriangleInTheOrderOfTheFile) {
  const Tree tree = stem_with_twigs(3, 6, 2);
  const PartTriangles part = trunk_triangles(tree);
  const std::vector<Float3> vertices = trunk_vertices(tree);
  ASSERT_EQ(part.triangles.size(), tree.trunk.triangles.size());
  for (std::size_t t = 0; t < part.triangles.size(); ++t) {
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(part.position_of[part.triangles[t][c]], tree.trunk.triangles[t].vertex[c]);
      EXPECT_EQ(part.vertices[part.triangles[t][c]].position, vertices[tree.trunk.triangles[t].vertex[c]]);
    }
  }
}

TEST(PartTriangles, CornersOfOneVertexNormalAndTexcoordAreOne) {
  const PartTriangles part = trunk_triangles(stem_with_twigs(3, 6, 0));
  EXPECT_EQ(part.vertices.size(), 18u);
}

TEST(PartTriangles, MakesNormalsWhereThereAreNone) {
  const PartTriangles part = trunk_triangles(stem_with_twigs(3, 8, 0));
  for (const SpectrumVertex& v : part.vertices) {
    EXPECT_NEAR(length(to_double(v.normal)), 1, 1e-6);
    // The side of a stem; which way depends on the winding of the fixture, but the same everywhere.
    EXPECT_GT(std::abs(v.normal.x * v.position.x + v.normal.z * v.position.z), 0.4);
  }
}

TEST(PartTriangles, ALeafKeepsItsRunAndItsMaterial) {
  Tree tree;
  tree.leaves.vertices =
      std::vector<Float3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}};
  std::vector<CornerTriangle> triangles(2);
  triangles[0].vertex = {0, 1, 2}, triangles[1].vertex = {3, 4, 5};
  tree.leaves.triangles = triangles;
  tree.leaves.centres = std::vector<Float3>{{0, 0, 0}, {5, 0, 0}};
  tree.leaves.materials = std::vector<std::uint32_t>{7, 9};
  tree.header.leaf_factor = 1;
  EXPECT_EQ(leaf_triangles(tree).materials, (std::vector<std::uint32_t>{7, 9}));
}

TEST(PartTriangles, NothingOfAnEmptyTree) {
  EXPECT_TRUE(trunk_triangles(Tree{}).triangles.empty());
  EXPECT_TRUE(leaf_triangles(Tree{}).triangles.empty());
}

}  // namespace
}  // namespace copse
