#include "lib/analysis/lod/leaf_elements.h"

#include "tests/lod/leafy_tree.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(LeafElements, ANodeIsATriangleOrACardThatIsCutOutOfAPicture) {
  for (const bool alpha : {false, true}) {
    const LeafPieces pieces = leaf_pieces(LeafyTree{.leaves = 30, .alpha = alpha}.make());
    LeafElements elements(pieces);
    ASSERT_EQ(elements.size(), alpha ? 30u : 60u);
    for (std::uint32_t n = 0; n < elements.size(); ++n) {
      const DrawnLeaf leaf = elements.drawn(n);
      EXPECT_EQ(elements.source(n).size(), alpha ? 2u : 1u);
      EXPECT_EQ(leaf.triangles().size(), elements.source(n).size());
      EXPECT_EQ(leaf.vertices().size(), alpha ? 4u : 3u);
      EXPECT_NEAR(leaf.area(), alpha ? 0.04 : 0.02, 1e-6);
      EXPECT_EQ(elements.piece(n), alpha ? n : n / 2);
    }
  }
}

TEST(LeafElements, WithoutAMergeThereIsFullDetailAlone) {
  const LeafPieces pieces = leaf_pieces(LeafyTree{.leaves = 5}.make());
  const Spectrum s = LeafElements(pieces).finish();
  EXPECT_EQ(s.steps(), 0u);
  EXPECT_EQ(s.counts[0], 10u);
}

TEST(LeafElements, AMergeReplacesItsNodesAndLeavesTheRestOfTheirPieces) {
  const LeafPieces pieces = leaf_pieces(LeafyTree{.leaves = 3}.make());
  LeafElements elements(pieces);
  const DrawnLeaf first = elements.drawn(0);
  elements.merge(std::array<std::uint32_t, 2>{0, 2}, first, 0, k_none, 0.5);  // of two cards
  elements.merge(std::array<std::uint32_t, 3>{0, 1, 3}, first, 0, k_none, 0.7);
  const Spectrum s = elements.finish();
  ASSERT_EQ(s.steps(), 2u);
  EXPECT_EQ(s.counts[1], 5u);
  EXPECT_EQ(s.counts[2], 3u) << "one for two cards, and the card that was not touched";
  EXPECT_EQ(s.errors[2], round_up(0.7));
}

TEST(LeafElements, APieceOfManyTrianglesIsDrawnAsItIs) {
  Tree tree;
  std::vector<Float3> vertices;
  std::vector<CornerTriangle> triangles;
  for (int i = 0; i < 6; ++i) vertices.push_back({float(i / 2), float(i % 2), 0});
  for (std::uint32_t i = 0; i < 4; ++i) {
    CornerTriangle t;
    for (std::uint32_t c = 0; c < 3; ++c) t.vertex[c] = i + c, t.texcoord[c] = 0;
    triangles.push_back(t);
  }
  LeafyTree maker{.groups = 1, .alpha = true};
  maker.finish(tree, vertices, triangles, {Float3{1, 0.5f, 0}});
  tree.header.leaf_factor = 4;
  const LeafPieces pieces = leaf_pieces(tree);
  LeafElements elements(pieces);
  ASSERT_EQ(elements.size(), 1u);
  const DrawnLeaf leaf = elements.drawn(0);
  ASSERT_NE(leaf.frond, nullptr);
  EXPECT_EQ(leaf.triangles().size(), 4u);
  EXPECT_EQ(leaf.vertices().size(), 6u);
  EXPECT_NEAR(leaf.area(), 2, 1e-6);
}

TEST(LeafElements, OfNoLeavesThereIsNothing) {
  const LeafPieces pieces = leaf_pieces(Tree{});
  LeafElements elements(pieces);
  EXPECT_EQ(elements.size(), 0u);
  EXPECT_TRUE(elements.finish().elements.empty());
}

}  // namespace
}  // namespace copse
