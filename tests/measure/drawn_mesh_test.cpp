#include "lib/analysis/measure/drawn_mesh.h"

#include "tests/measure/shapes_to_draw.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

// The left half of a 4 x 2 picture is transparent.
const std::vector<std::uint8_t> k_half = [] {
  std::vector<std::uint8_t> rgba;
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 4; ++x) rgba.insert(rgba.end(), {9, 9, 9, std::uint8_t(x < 2 ? 0 : 255)});
  return rgba;
}();

Tree two_triangles_that_share_an_edge() {
  Tree tree;
  tree.header.leaf_factor = 2;
  tree.leaves.vertices = std::vector<Float3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  tree.leaves.texcoords = std::vector<Float2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  CornerTriangle a, b;
  a.vertex = {0, 1, 2}, a.texcoord = {0, 1, 2};
  b.vertex = {0, 2, 3}, b.texcoord = {0, 2, 3};
  tree.leaves.triangles = std::vector<CornerTriangle>{a, b};
  tree.leaves.centres = std::vector<Float3>{{0.5f, 0.5f, 0}};
  tree.leaves.material = 0;
  return tree;
}

TEST(DrawnMesh, SharesThePositionsOfCornersThatAreAlike) {
  const DrawnMesh m = drawn_leaves(two_triangles_that_share_an_edge());
  EXPECT_EQ(m.positions.size(), 4u);
  EXPECT_EQ(m.texcoords.size(), 4u);
  EXPECT_TRUE(m.normals.empty());
  EXPECT_EQ(m.material, (std::vector<std::uint32_t>{0, 0}));
  EXPECT_DOUBLE_EQ(area(m), 1);
}

TEST(DrawnMesh, SplitsAPositionWhereTextureCoordinatesDiffer) {
  Tree tree = two_triangles_that_share_an_edge();
  auto triangles = tree.leaves.triangles.to_vector();
  triangles[1].texcoord[0] = 1;
  tree.leaves.triangles = triangles;
  EXPECT_EQ(drawn_leaves(tree).positions.size(), 5u);
}

TEST(DrawnMesh, OfATreeWithoutLeavesOrTrunkIsEmpty) {
  EXPECT_TRUE(drawn_leaves(Tree{}).triangles.empty());
  EXPECT_TRUE(drawn_trunk(Tree{}).triangles.empty());
}

TEST(DrawnMesh, AppendedKeepsBothPartsAndPadsWhatOneOfThemLacks) {
  DrawnMesh m = square({}, 1);
  DrawnMesh bare = square({5, 0, 0}, 2, 3);
  bare.texcoords.clear();
  bare.normals.assign(4, {0, 0, 1});
  append(m, bare);
  EXPECT_EQ(m.texcoords.size(), m.positions.size());
  EXPECT_EQ(m.normals.size(), m.positions.size());
  EXPECT_EQ(m.normals[7], (Float3{0, 0, 1}));
  EXPECT_DOUBLE_EQ(area(m), 4 + 16);
  EXPECT_EQ(m.material.back(), 3u);
  EXPECT_EQ(bounds(m).max.x, 7);
}

TEST(DrawnMesh, MasksPassWhatTheAlphaTestPasses) {
  std::vector<Material> materials(2);
  materials[0].texture = 0;
  const auto masks = alpha_masks(materials, [](std::uint32_t) { return TextureImage{4, 2, k_half}; });
  ASSERT_EQ(masks.size(), 2u);
  EXPECT_FALSE(masks[0].passes(0.1, 0.5));
  EXPECT_TRUE(masks[0].passes(0.9, 0.5));
  EXPECT_TRUE(masks[0].passes(-0.1, 7.5)) << "textures repeat";
  EXPECT_TRUE(masks[1].opaque.empty()) << "no texture, no mask";
  EXPECT_TRUE(masks[1].passes(0.1, 0.5));
}

TEST(DrawnMesh, AMaterialWhoseImageIsMissingIsOpaque) {
  std::vector<Material> materials(1);
  materials[0].texture = 0;
  const auto masks = alpha_masks(materials, [](std::uint32_t) { return std::optional<TextureImage>{}; });
  EXPECT_TRUE(masks[0].opaque.empty());
}

}  // namespace
}  // namespace copse
