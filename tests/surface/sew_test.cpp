#include "lib/analysis/surface/sew.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

using Ids = std::vector<std::uint32_t>;

// Pieces laid out so that none is folded back on another.
Ids sew_flat(const std::vector<Triangle>& triangles, const Ids& piece) {
  return sew(std::vector<Double3>(10), triangles, piece);
}

// Cups of three triangles over the edges of one triangle, piece i with its tip at tips[i]; wound outwards.
Ids sew_cups(const std::vector<Double3>& tips) {
  std::vector<Double3> points{{1, 0, 0}, {0, 1, 0}, {-1, -1, 0}};
  std::vector<Triangle> triangles;
  Ids piece;
  for (const Double3& tip : tips) {
    const auto id = static_cast<std::uint32_t>(points.size());
    points.push_back(tip);
    for (std::uint32_t i = 0; i < 3; ++i) {
      Triangle t{i, (i + 1) % 3, id};
      if (tip.z < 0) std::swap(t[0], t[1]);
      triangles.push_back(t);
      piece.push_back(id - 3);
    }
  }
  return sew(points, triangles, piece);
}

TEST(Sew, LeavesApartWhatBeginsInOnePlaceAndLeadsTheSameWay) {
  EXPECT_EQ(sew_cups({{0, 0, 2}, {0, 0, -2}}), (Ids{0, 0}));
  EXPECT_EQ(sew_cups({{0, 0, 2}, {.5, 0, 2}}), (Ids{0, 1}));
  EXPECT_EQ(sew_cups({{0, 0, 2}, {2, 0, 1}, {0, 2, 1}}), (Ids{0, 1, 2}));
  // A fork: all three where one comes from the other side.
  EXPECT_EQ(sew_cups({{0, 0, 2}, {.5, 0, 2}, {0, 0, -2}}), (Ids{0, 0, 0}));
}

TEST(Sew, JoinsPiecesWhoseBoundaryEdgesCoincide) {
  EXPECT_EQ(sew_flat(std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {3, 4, 5}}, Ids{0, 1, 2}), (Ids{0, 0, 2}));
}

TEST(Sew, LeavesPiecesThatShareAPointOrAnInnerEdge) {
  EXPECT_EQ(sew_flat(std::vector<Triangle>{{0, 1, 2}, {2, 3, 4}}, Ids{0, 1}), (Ids{0, 1}));
  // Both fold over the edge 0-1: it lies inside both.
  const std::vector<Triangle> folds{{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {1, 0, 5}};
  EXPECT_EQ(sew_flat(folds, Ids{0, 0, 1, 1}), (Ids{0, 1}));
}

TEST(Sew, JoinsALoopThatLandsOnInnerEdgesButNotAPartOfOne) {
  // A closed tetrahedron; a cup whose rim is the tetrahedron's first face, and a flap on one of its edges.
  std::vector<Triangle> t{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  Ids piece(4, 0);
  for (const Triangle& cup : {Triangle{0, 1, 4}, Triangle{1, 2, 4}, Triangle{2, 0, 4}}) {
    t.push_back(cup);
    piece.push_back(1);
  }
  t.push_back({1, 3, 9});
  piece.push_back(2);
  EXPECT_EQ(sew_flat(t, piece), (Ids{0, 0, 2}));
}

TEST(Sew, OfNothingIsNothing) {
  EXPECT_TRUE(sew({}, {}, {}).empty());
}

}  // namespace
}  // namespace copse
