#include "lib/analysis/leaves/leaf_units.h"

#include "lib/analysis/surface/weld.h"
#include "lib/formats/random.h"
#include "tests/leaves/shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace copse {
namespace {

using shapes::Builder;
using testing::ElementsAre;

LeafUnits units(const Mesh& mesh, std::vector<std::uint8_t> is_leaf = {}) {
  const std::vector<std::uint32_t> welded = weld(mesh.positions, 0.0);
  std::vector<std::uint32_t> keys(mesh.parts.size());
  for (std::uint32_t p = 0; p < keys.size(); ++p) keys[p] = p;
  const Pieces pieces = edge_pieces(mesh.triangles, welded, mesh.part_of, keys);
  if (is_leaf.empty()) is_leaf.assign(pieces.count, 1);
  return leaf_units(mesh, welded, triangles_of(pieces.of, pieces.count), is_leaf);
}

TEST(LeafUnits, OfNoPiecesAreNone) {
  EXPECT_EQ(units({}).count, 0u);
}

TEST(LeafUnits, PiecesThatAreNoLeavesGetNone) {
  Builder b;
  for (int i = 0; i < 3; ++i) b.card({i * 3.0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const LeafUnits u = units(b.mesh, {1, 0, 1});
  EXPECT_THAT(u.of, ElementsAre(0, k_none, 1));
}

TEST(LeafUnits, CrossedCardsPairInWhateverOrderTheyCome) {
  Builder b;
  for (int i = 0; i < 40; ++i) b.card({i * 3.0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  for (int i = 40; i-- > 0;) b.card({i * 3.0 + 1e-7, 0, 0}, {0, 0, 1}, {0, 1, 0});
  const LeafUnits u = units(b.mesh);
  EXPECT_EQ(u.count, 40u);
  for (std::uint32_t i = 0; i < 40; ++i) EXPECT_EQ(u.of[i], u.of[79 - i]);
}

TEST(LeafUnits, TrianglesThatAreThereTwiceOrHaveNoAreaDoNotCount) {
  Builder b;
  for (int i = 0; i < 6; ++i) {
    const auto first = static_cast<std::uint32_t>(b.mesh.positions.size());
    b.card({i * 9.0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    if (i % 3 == 1) b.triangle(first + 1, first, first + 2);
    if (i % 3 == 2) b.triangle(first, first, first + 1);
    b.card({i * 9.0, 0, 0}, {0, 0, 1}, {0, 1, 0});
  }
  EXPECT_EQ(units(b.mesh).count, 6u);
}

TEST(LeafUnits, FrontAndBackOfTwoMaterialsAreOneLeaf) {
  Builder b;
  for (int side = 0; side < 2; ++side) {
    b.part("");
    for (int i = 0; i < 5; ++i) b.card({i * 3.0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  }
  EXPECT_EQ(units(b.mesh).count, 5u);
}

TEST(LeafUnits, CardsOfOtherSizesOrShapesInOnePlaceStayApart) {
  Builder b;
  for (int i = 0; i < 6; ++i) {
    b.card({i * 9.0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    b.card({i * 9.0, 0, 0}, {0, 0, 2}, {0, 2, 0});
  }
  EXPECT_EQ(units(b.mesh).count, 12u);
}

TEST(LeafUnits, CardsThatCrossMayDifferInWidth) {
  Builder b;
  for (int i = 0; i < 6; ++i) {
    b.card({i * 9.0, 0, 0}, {0.2, 0, 0}, {0, 1, 0});
    b.card({i * 9.0, 0, 0}, {0, 0, 1}, {0, 1, 0});
  }
  EXPECT_EQ(units(b.mesh).count, 6u);
}

TEST(LeafUnits, AFewThatMeetAmongManyThatDoNotStayApart) {
  Builder b;
  for (int i = 0; i < 9; ++i) b.card({i * 3.0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  for (int i = 0; i < 2; ++i) b.card({i * 3.0, 0, 0}, {0, 0, 1}, {0, 1, 0});
  EXPECT_EQ(units(b.mesh).count, 11u);
}

TEST(LeafUnits, CardsNearEachOtherDoNotPair) {
  Builder b;
  Random random(1);
  for (int i = 0; i < 200; ++i)
    b.card({i * 0.01, random.uniform(), 0}, {1, 0, 0}, {0, 1, random.around(0, 0.01)});
  EXPECT_EQ(units(b.mesh).count, 200u);
}

TEST(LeafUnits, ManyLeavesInOnePlaceAreNoTrap) {
  Builder b;
  for (int i = 0; i < 20000; ++i) {
    b.part("");
    b.triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  }
  EXPECT_EQ(units(b.mesh).count, 1u);
}

}  // namespace
}  // namespace copse
