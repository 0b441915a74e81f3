#include "lib/analysis/tree/leaf_arrays.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

// Trunk triangle, leaf 1, leaf 0 (a quad), leaf 1 again.
Mesh mesh_of_leaves() {
  Mesh mesh;
  for (int i = 0; i < 12; ++i) mesh.positions.push_back({double(i), double(i * i % 7), 0});
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {6, 8, 9}, {3, 5, 10}};
  mesh.parts = {{"", "", 0}, {"", "", 1}};
  mesh.part_of = {0, 1, 1, 1, 1};
  return mesh;
}

const std::vector<std::uint32_t> k_leaf_of{k_none, 1, 0, 0, 1};

LeafArrays arrays_of(const Mesh& mesh, const std::vector<std::uint32_t>& leaf_of, std::uint32_t leaves,
                     const Double3& origin = {}) {
  return make_leaf_arrays(mesh, leaf_geometry(mesh, leaf_of, leaves), origin);
}

TEST(LeafArrays, PutTrianglesLeafAfterLeaf) {
  const LeafArrays a = arrays_of(mesh_of_leaves(), k_leaf_of, 2);
  EXPECT_EQ(a.leaf_factor, 2u);
  EXPECT_TRUE(a.leaves.first_triangle.empty());
  ASSERT_EQ(a.leaves.triangles.size(), 4u);
  EXPECT_EQ(a.leaves.vertices[a.leaves.triangles[0].vertex[0]].x, 6);
  EXPECT_EQ(a.leaves.vertices[a.leaves.triangles[3].vertex[2]].x, 10);
  EXPECT_EQ(a.leaves.vertices.size(), 8u);  // only what leaves use
  EXPECT_EQ(a.leaves.material, 1u);
  EXPECT_EQ(a.bounds.min.x, 3);
}

TEST(LeafArrays, StoreOffsetsWhereLeavesDiffer) {
  const LeafArrays a = arrays_of(mesh_of_leaves(), {k_none, 1, 0, 0, k_none}, 2);
  EXPECT_EQ(a.leaf_factor, 0u);
  EXPECT_EQ(a.leaves.first_triangle.to_vector(), (std::vector<std::uint32_t>{0, 2, 3}));
}

TEST(LeafArrays, CountLeavesOfSeveralMaterials) {
  Mesh mesh = mesh_of_leaves();
  mesh.part_of[4] = 0;
  const LeafArrays a = arrays_of(mesh, k_leaf_of, 2);
  EXPECT_EQ(a.mixed_materials, 1u);
  EXPECT_EQ(a.leaves.material, 1u);
}

TEST(LeafArrays, AreRelativeToTheOrigin) {
  const LeafArrays a = arrays_of(mesh_of_leaves(), k_leaf_of, 2, {1, 1, 1});
  EXPECT_EQ(a.leaves.centres[1].z, -1);
  EXPECT_EQ(a.bounds.min.x, 2);
}

TEST(LeafArrays, OfATreeWithoutLeavesAreEmpty) {
  const LeafArrays a = arrays_of(mesh_of_leaves(), std::vector<std::uint32_t>(5, k_none), 0);
  EXPECT_TRUE(a.leaves.triangles.empty());
  EXPECT_TRUE(a.leaves.first_triangle.empty());
  EXPECT_TRUE(a.bounds.empty());
}

}  // namespace
}  // namespace copse
