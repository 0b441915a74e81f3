#include "lib/formats/export/export.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

// Two trunk triangles of different materials, a quad leaf and a single one, far from the origin.
Tree small_tree() {
  Tree tree;
  tree.header.kind = TreeKind::still;
  tree.header.origin = {1e6, 0, 0};
  tree.header.segment_factor = 1;
  tree.materials = {Material{.name = "bark"}, Material{.name = "moss"},
                    Material{.name = "leaf", .texture = 0}};
  tree.textures = {Texture{.uri = "leaf.png", .mime = {}, .bytes = {}}};
  tree.trunk.vertices = std::vector<Float3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  tree.trunk.normals = std::vector<Float3>{{0, 0, 1}};
  CornerTriangle t;
  t.vertex = {0, 1, 2};
  t.normal = {0, 0, k_none};
  CornerTriangle u;
  u.vertex = {1, 3, 2};
  tree.trunk.triangles = std::vector<CornerTriangle>{t, u};
  tree.trunk.materials = std::vector<std::uint32_t>{0, 1};
  tree.leaves.vertices = std::vector<Float3>{{0, 2, 0}, {1, 2, 0}, {1, 3, 0}, {0, 3, 0}};
  tree.leaves.texcoords = std::vector<Float2>{{0, 0}, {1, 1}};
  CornerTriangle a, b, c;
  a.vertex = {0, 1, 2};
  a.texcoord = {0, 1, 1};
  b.vertex = {0, 2, 3};
  c.vertex = {3, 2, 1};
  tree.leaves.triangles = std::vector<CornerTriangle>{a, b, c};
  tree.leaves.first_triangle = std::vector<std::uint32_t>{0, 2, 3};
  tree.leaves.centres = std::vector<Float3>{{0.5f, 2.5f, 0}, {0.5f, 2.5f, 0}};
  tree.leaves.materials = std::vector<std::uint32_t>{2, 0};
  return tree;
}

TEST(TreeMesh, TrunkComesFirstThenLeavesOnePartAMaterial) {
  const Mesh mesh = to_mesh(small_tree());
  ASSERT_EQ(mesh.triangles.size(), 5u);
  EXPECT_EQ(mesh.part_of, (std::vector<std::uint32_t>{0, 1, 2, 2, 3}));
  EXPECT_EQ(mesh.parts[0], (Part{"trunk", "trunk", 0}));
  EXPECT_EQ(mesh.parts[1], (Part{"trunk", "trunk", 1}));
  EXPECT_EQ(mesh.parts[2], (Part{"leaves", "leaves", 2}));
  EXPECT_EQ(mesh.parts[3], (Part{"leaves", "leaves", 0}));
}

TEST(TreeMesh, CoordinatesAreAbsolute) {
  const Mesh mesh = to_mesh(small_tree());
  EXPECT_EQ(mesh.positions[1], (Double3{1e6 + 1, 0, 0}));
  EXPECT_EQ(mesh.triangles[2], (Triangle{4, 5, 6}));
}

TEST(TreeMesh, CornersKeepWhatTheyHave) {
  const Mesh mesh = to_mesh(small_tree());
  EXPECT_EQ(mesh.normal_triangles[0], (Triangle{0, 0, k_none}));
  EXPECT_EQ(mesh.normal_triangles[2], (Triangle{k_none, k_none, k_none}));
  EXPECT_EQ(mesh.texcoord_triangles[2], (Triangle{0, 1, 1}));
}

TEST(TreeMesh, WhatWasLeftOutOfTheFileIsLeftOutOfTheMesh) {
  Tree tree = small_tree();
  tree.trunk.normals = {};
  tree.leaves.vertices = {};
  tree.textures.clear();
  const Mesh mesh = to_mesh(tree);
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_TRUE(mesh.normal_triangles.empty());
  EXPECT_EQ(mesh.materials[2].texture, k_none);
  EXPECT_TRUE(export_mesh(mesh, ExportFormat::glb, "a.glb"));
}

TEST(TreeMesh, LeavesWithoutOffsetsKeepTheirTriangles) {
  Tree tree = small_tree();
  tree.leaves.first_triangle = {};
  EXPECT_EQ(to_mesh(tree).triangles.size(), 5u);
}

TEST(TreeMesh, AnEmptyTreeIsAnEmptyMesh) {
  EXPECT_TRUE(to_mesh(Tree{}).triangles.empty());
}

}  // namespace
}  // namespace copse
