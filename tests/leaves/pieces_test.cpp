#include "lib/analysis/leaves/pieces.h"

#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace copse {
namespace {

using testing::ElementsAre;

struct Case {
  std::vector<Triangle> triangles{};
  std::vector<std::uint32_t> welded{};   // identity when empty
  std::vector<std::uint32_t> part_of{};  // 0 when empty
  std::vector<std::uint32_t> keys{0, 1, 2};
};

Pieces pieces_of(Case c) {
  if (c.welded.empty()) {
    c.welded.resize(100);
    std::iota(c.welded.begin(), c.welded.end(), 0u);
  }
  if (c.part_of.empty()) c.part_of.assign(c.triangles.size(), 0);
  return edge_pieces(c.triangles, c.welded, c.part_of, c.keys);
}

TEST(Pieces, OfNothingAreNone) {
  EXPECT_EQ(pieces_of({}).count, 0u);
}

TEST(Pieces, AnEdgeJoinsAndAPointDoesNot) {
  const Pieces pieces = pieces_of({.triangles = {{0, 1, 2}, {2, 1, 3}, {3, 4, 5}}});
  EXPECT_THAT(pieces.of, ElementsAre(0, 0, 1));
  EXPECT_EQ(pieces.edges[0], Pieces::border_0 | Pieces::border_0 << 2);
  EXPECT_EQ(pieces.edges[2], Pieces::border_0 | Pieces::border_0 << 1 | Pieces::border_0 << 2);
}

TEST(Pieces, JoinThroughWeldedSeams) {
  const Pieces pieces = pieces_of({.triangles = {{0, 1, 2}, {3, 4, 5}}, .welded = {0, 1, 2, 2, 1, 5}});
  EXPECT_EQ(pieces.count, 1u);
}

TEST(Pieces, NeverJoinAcrossKeysButSeeTheNeighbour) {
  const Pieces pieces = pieces_of({.triangles = {{0, 1, 2}, {2, 1, 3}}, .part_of = {0, 1}});
  EXPECT_EQ(pieces.count, 2u);
  EXPECT_TRUE(pieces.edges[0] & Pieces::neighbour_0 << 1);
  EXPECT_TRUE(pieces.edges[0] & Pieces::border_0 << 1);
  EXPECT_TRUE(pieces.edges[1] & Pieces::neighbour_0);
}

TEST(Pieces, PartsOfOneKeyJoin) {
  EXPECT_EQ(pieces_of({.triangles = {{0, 1, 2}, {2, 1, 3}}, .part_of = {0, 1}, .keys = {7, 7}}).count, 1u);
}

TEST(Pieces, ThreeCardsOnOneEdgeAreOnePieceAndNotManifold) {
  const Pieces pieces = pieces_of({.triangles = {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}}});
  EXPECT_EQ(pieces.count, 1u);
  for (const std::uint8_t edges : pieces.edges) EXPECT_TRUE(edges & Pieces::non_manifold);
}

TEST(Pieces, BackToBackTrianglesAreOnePieceWithoutBorder) {
  const Pieces pieces = pieces_of({.triangles = {{0, 1, 2}, {2, 1, 0}}});
  EXPECT_EQ(pieces.count, 1u);
  EXPECT_EQ(pieces.edges[0], 0);
}

TEST(Pieces, TrianglesWeldedToALineOrAPointStayWithTheirNeighbours) {
  // 3 is welded to 0: triangle 1 is a line along an edge of triangle 0, triangle 2 a point.
  const Pieces pieces = pieces_of({.triangles = {{0, 1, 2}, {0, 3, 1}, {0, 3, 0}, {5, 5, 5}, {6, 6, 6}},
                                   .welded = {0, 1, 2, 0, 4, 5, 5}});
  EXPECT_THAT(pieces.of, ElementsAre(0, 0, 0, 1, 1));
}

TEST(Pieces, AHubOfManyTrianglesIsSortedNotSearched) {
  std::vector<Triangle> fan;
  for (std::uint32_t i = 0; i < 200000; ++i) fan.push_back({0, i + 1, i + 2});
  std::vector<std::uint32_t> welded(200002);
  std::iota(welded.begin(), welded.end(), 0u);
  EXPECT_EQ(pieces_of({.triangles = fan, .welded = welded}).count, 1u);
}

TEST(Pieces, TrianglesAreListedPieceAfterPieceInTheirOrder) {
  const std::vector<std::uint32_t> of{0, 1, 0, 2, 1};
  const PieceTriangles listed = triangles_of(of, 3);
  EXPECT_THAT(listed.first, ElementsAre(0, 2, 4, 5));
  EXPECT_THAT(listed.triangle, ElementsAre(0, 2, 1, 4, 3));
  EXPECT_THAT(listed.of(1), ElementsAre(1, 4));
}

}  // namespace
}  // namespace copse
