#include "lib/analysis/lod/leaf_pieces.h"

#include "tests/lod/leafy_tree.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

// One leaf of two cards that cross.
Tree crossed(bool alpha) {
  std::vector<Float3> vertices;
  std::vector<CornerTriangle> triangles;
  LeafyTree::add_card({}, {1, 0, 0}, {0, 1, 0}, vertices, triangles);
  LeafyTree::add_card({}, {0, 0, 1}, {0, 1, 0}, vertices, triangles);
  Tree tree;
  const LeafyTree maker{.leaves = 1, .groups = 1, .alpha = alpha};
  maker.finish(tree, vertices, triangles, {{0, 0, 0}});
  tree.header.leaf_factor = 4;
  return tree;
}

TEST(LeafPieces, CutsALeafIntoItsCards) {
  const LeafPieces p = leaf_pieces(crossed(false));
  ASSERT_EQ(p.list.size(), 2u);
  EXPECT_EQ(p.list[0].last - p.list[0].first, 2u);
  EXPECT_EQ(p.list[1].leaf, 0u);
  EXPECT_EQ(p.list[1].group, 0u);
  EXPECT_EQ(p.list[1].radius, k_none) << "a tree without trunk";
  EXPECT_EQ(p.triangles, (std::vector<std::uint32_t>{0, 1, 2, 3}));
}

TEST(LeafPieces, OnlyWhatHasAlphaIsACard) {
  EXPECT_FALSE(leaf_pieces(crossed(false)).list[0].card);
  EXPECT_EQ(leaf_pieces(crossed(false)).list[0].cut, LeafCut::triangle);
  EXPECT_TRUE(leaf_pieces(crossed(true)).list[0].card);
  EXPECT_EQ(leaf_pieces(crossed(true)).list[0].cut, LeafCut::card);
  EXPECT_EQ(leaf_pieces(crossed(true)).opacity_of(0), 0.5);
}

TEST(LeafPieces, TakesTheBoxOfTheTextureCoordinatesFromTheLowerLeft) {
  const auto uv = leaf_pieces(crossed(true)).texcoords(0, 0);
  EXPECT_EQ(uv[0], (Float2{0, 0}));
  EXPECT_EQ(uv[1], (Float2{1, 0}));
  EXPECT_EQ(uv[2], (Float2{1, 1}));
  EXPECT_EQ(uv[3], (Float2{0, 1}));
}

TEST(LeafPieces, KnowsWhereATexturesTopIs) {
  const Double3 up = leaf_pieces(crossed(true)).up_of(0);
  EXPECT_NEAR(distance(up, {0, 1, 0}), 0, 1e-6);
}

TEST(LeafPieces, OfNoLeavesAreNone) {
  EXPECT_TRUE(leaf_pieces(Tree{}).list.empty());
}

}  // namespace
}  // namespace copse
