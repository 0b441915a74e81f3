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
  elements.merge(std::array<std::uint32_t, 2>{0, 2}, first, 0, k_none);  // of two cards
  elements.merge(std::array<std::uint32_t, 3>{0, 1, 3}, first, 0, k_none);
  const Spectrum s = elements.finish();
  ASSERT_EQ(s.steps(), 2u);
  EXPECT_EQ(s.counts[1], 5u);
  EXPECT_EQ(s.counts[2], 3u) << "one for two cards, and the card that was not touched";
}

TEST(LeafElements, WhatIsRemovedIsGoneAndComesBackWhenMergesAreShown) {
  const LeafPieces pieces = leaf_pieces(LeafyTree{.leaves = 4}.make());
  LeafElements elements(pieces);
  const DrawnLeaf first = elements.drawn(0), last = elements.drawn(7);
  for (const std::uint32_t n : {1u, 2u, 3u}) elements.remove(std::span(&n, 1));
  elements.remove(std::array<std::uint32_t, 2>{6, 7});
  elements.hold({6, 7, 0, 1, 2, 3, 4, 5}, 3);
  elements.merge(std::array<std::uint32_t, 3>{0, 1, 2}, first, 0, k_none);
  elements.merge(std::array<std::uint32_t, 3>{7, 4, 5}, last, 0, k_none);
  elements.merge(std::array<std::uint32_t, 2>{0, 3}, last, 0, k_none);
  elements.show_at(4);  // not yet
  elements.show_at(3);
  elements.merge(std::array<std::uint32_t, 2>{0, 7}, first, 0, k_none);
  const Spectrum s = elements.finish();
  const std::vector<std::uint32_t> counts(s.counts.begin(), s.counts.end());
  EXPECT_EQ(std::vector(counts.begin(), counts.begin() + 5), (std::vector<std::uint32_t>{8, 7, 6, 5, 3}));
  EXPECT_EQ(counts.back(), 2u) << "6, which was removed, is back; 0 is what all others have become";
  std::size_t last_leaves = 0;
  for (const SpectrumElement& e : s.elements) last_leaves += e.death == k_none;
  EXPECT_EQ(last_leaves, 2u);
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
