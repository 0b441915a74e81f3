#include "lib/analysis/surface/sew.h"

#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

using Ids = std::vector<std::uint32_t>;

// Pieces laid out so that none is folded back on another.
Ids sew_flat(const std::vector<Triangle>& triangles, const Ids& piece) {
  return sew(std::vector<Double3>(10), triangles, piece);
}

// Cups of three triangles over the edges of one triangle, piece i with its tip at tips[i]; wound outwards.
Ids sew_cups(const std::vector<Double3>& tips, const Ids& turned = {}) {
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
  for (const std::uint32_t t : turned) std::swap(triangles[t][1], triangles[t][2]);
  return sew(points, triangles, piece);
}

TEST(Sew, LeavesApartWhatBeginsInOnePlaceAndLeadsTheSameWay) {
  EXPECT_EQ(sew_cups({{0, 0, 2}, {0, 0, -2}}), (Ids{0, 0}));
  EXPECT_EQ(sew_cups({{0, 0, 2}, {.5, 0, 2}}), (Ids{0, 1}));
  EXPECT_EQ(sew_cups({{0, 0, 2}, {2, 0, 1}, {0, 2, 1}}), (Ids{0, 1, 2}));
  // A fork: all three where one comes from the other side.
  EXPECT_EQ(sew_cups({{0, 0, 2}, {.5, 0, 2}, {0, 0, -2}}), (Ids{0, 0, 0}));
}

// Cups as above, of which some are wound inwards, wholly or in part: their shape tells.
TEST(Sew, DoesNotGoByTheFilesWinding) {
  for (const Ids& turned : {Ids{0, 1, 2}, Ids{3, 4, 5}, Ids{1}, Ids{4, 5}, Ids{0, 2, 4}}) {
    EXPECT_EQ(sew_cups({{0, 0, 2}, {0, 0, -2}}, turned), (Ids{0, 0}));
    EXPECT_EQ(sew_cups({{0, 0, 2}, {.5, 0, 2}}, turned), (Ids{0, 1}));
  }
}

// A prism of three sides, each of them a piece, as flat shading has it, and some turned over: edges are sharp
// and lie to the same side.
TEST(Sew, DoesNotFoldFacesThatWereTurnedOver) {
  std::vector<Double3> points;
  for (int ring = 0; ring < 4; ++ring) {
    for (int i = 0; i < 3; ++i) points.push_back({std::cos(2.1 * i), std::sin(2.1 * i), 2.0 * ring});
  }
  std::vector<Triangle> triangles;
  Ids piece;
  for (std::uint32_t f = 0; f < 9; ++f) {
    const std::uint32_t a = f, b = f / 3 * 3 + (f + 1) % 3;
    for (Triangle t : {Triangle{a, b, b + 3}, Triangle{a, b + 3, a + 3}}) {
      if (f == 1 || f == 5 || f == 6) std::swap(t[0], t[1]);
      triangles.push_back(t);
      piece.push_back(f);
    }
  }
  EXPECT_EQ(sew(points, triangles, piece), Ids(9, 0));
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
