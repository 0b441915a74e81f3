#include "lib/analysis/leaves/end_to_end.h"

#include "lib/analysis/surface/weld.h"
#include "tests/leaves/shapes.h"

#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace copse {
namespace {

using shapes::Builder;
using shapes::line;
using testing::ElementsAre;

// The chain of every piece, of which all are asked but those of `left_out`.
std::vector<std::uint32_t> chains(const Mesh& mesh, const std::vector<std::uint32_t>& left_out = {}) {
  const std::vector<std::uint32_t> welded = weld(mesh.positions, 0.0);
  std::vector<std::uint32_t> keys(mesh.parts.size());
  std::iota(keys.begin(), keys.end(), 0u);
  const Pieces pieces = edge_pieces(mesh.triangles, welded, mesh.part_of, keys);
  std::vector<std::uint32_t> asked;
  for (std::uint32_t p = 0; p < pieces.count; ++p) {
    if (std::ranges::find(left_out, p) == left_out.end()) asked.push_back(p);
  }
  return end_to_end(mesh, welded, pieces, triangles_of(pieces.of, pieces.count), asked);
}

TEST(EndToEnd, TubesOfOtherSidesGoOnFromOneAnother) {
  Builder b;
  b.tube(line({0, 0, 0}, {0, 1, 0}, 3), 0.2, 6);
  b.tube(line({0, 1, 0}, {0, 2, 0}, 3), 0.2, 9);
  b.tube(line({0, 2, 0}, {0, 3, 0}, 3), 0.2, 5);
  b.tube(line({4, 0, 0}, {4, 1, 0}, 3), 0.2, 5);
  EXPECT_THAT(chains(b.mesh), ElementsAre(0, 0, 0, 3));
}

TEST(EndToEnd, NothingGoesOnFromAThickerOrAPushedOne) {
  Builder b;
  b.tube(line({0, 0, 0}, {0, 1, 0}, 3), 0.2, 6);
  b.tube(line({0, 1, 0}, {0, 2, 0}, 3), 0.21, 9);
  b.tube(line({0, 1.01, 0}, {0, 2, 0}, 3), 0.2, 9);
  EXPECT_THAT(chains(b.mesh), ElementsAre(0, 1, 2));
}

TEST(EndToEnd, WhatBeginsSideBySideInOnePlaceDoesNotGoOnUnlessFromWhatEndsThere) {
  Builder b;
  b.tube(line({0, 1, 0}, {0.3, 2, 0}, 3), 0.2, 9);
  b.tube(line({0, 1, 0}, {-0.3, 2, 0}, 3), 0.2, 6);
  EXPECT_THAT(chains(b.mesh), ElementsAre(0, 1));
  b.tube(line({0, 0, 0}, {0, 1, 0}, 3), 0.2, 7);
  EXPECT_THAT(chains(b.mesh), ElementsAre(0, 0, 0));
}

TEST(EndToEnd, RoundingOfAFileDoesNotMatter) {
  Builder b;
  b.tube(line({0, 0, 0}, {0, 1, 0}, 3), 0.2, 6);
  b.tube(line({0, 1 + 1e-6, 1e-6}, {0, 2, 0}, 3), 0.2 + 1e-6, 9);
  EXPECT_THAT(chains(b.mesh), ElementsAre(0, 0));
}

TEST(EndToEnd, AnotherMaterialIsAnotherThing) {
  Builder b;
  b.part("", b.material("a"));
  b.tube(line({0, 0, 0}, {0, 1, 0}, 3), 0.2, 6);
  b.part("", b.material("b"));
  b.tube(line({0, 1, 0}, {0, 2, 0}, 3), 0.2, 9);
  EXPECT_THAT(chains(b.mesh), ElementsAre(0, 1));
}

TEST(EndToEnd, WhatIsNotAskedIsOnItsOwn) {
  Builder b;
  b.tube(line({0, 0, 0}, {0, 1, 0}, 3), 0.2, 6);
  b.tube(line({0, 1, 0}, {0, 2, 0}, 3), 0.2, 9);
  b.tube(line({0, 2, 0}, {0, 3, 0}, 3), 0.2, 6);
  EXPECT_THAT(chains(b.mesh, {1}), ElementsAre(0, 1, 2));
}

TEST(EndToEnd, ClosedPiecesAndBordersThatTouchThemselvesHaveNoRing) {
  Builder b;
  b.ball({0, 0, 0}, 1);
  b.ball({0, 0, 0}, 1, 2);
  // Two triangles that meet in a point and over a bridge: the border runs through the point twice.
  const std::uint32_t o = b.point({9, 0, 0}), p = b.point({10, 1, 0}), q = b.point({10, -1, 0});
  const std::uint32_t r = b.point({8, 1, 0}), s = b.point({8, -1, 0}), t = b.point({9, 3, 0});
  b.triangle(o, p, q), b.triangle(o, r, s), b.triangle(p, r, t);
  EXPECT_EQ(chains(b.mesh).size(), 5u);  // pieces are joined by edges alone
  EXPECT_THAT(chains(b.mesh), ElementsAre(0, 1, 2, 3, 4));
}

TEST(EndToEnd, AnEmptyMeshHasNoChains) {
  EXPECT_TRUE(chains(Mesh{}).empty());
}

TEST(EndToEnd, SizesOfAnyMagnitudeAreTakenAlike) {
  for (const double size : {1e-30, 1.0, 1e30}) {
    Builder b;
    b.tube(line({0, 0, 0}, Double3{0, 1, 0} * size, 3), 0.2 * size, 6);
    b.tube(line(Double3{0, 1, 0} * size, Double3{0, 2, 0} * size, 3), 0.2 * size, 9);
    EXPECT_THAT(chains(b.mesh), ElementsAre(0, 0)) << size;
  }
}

}  // namespace
}  // namespace copse
