#include "lib/analysis/surface/sew.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

using Ids = std::vector<std::uint32_t>;

TEST(Sew, JoinsPiecesWhoseBoundaryEdgesCoincide) {
  EXPECT_EQ(sew(std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {3, 4, 5}}, Ids{0, 1, 2}), (Ids{0, 0, 2}));
}

TEST(Sew, LeavesPiecesThatShareAPointOrAnInnerEdge) {
  EXPECT_EQ(sew(std::vector<Triangle>{{0, 1, 2}, {2, 3, 4}}, Ids{0, 1}), (Ids{0, 1}));
  // Both fold over the edge 0-1: it lies inside both.
  const std::vector<Triangle> folds{{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {1, 0, 5}};
  EXPECT_EQ(sew(folds, Ids{0, 0, 1, 1}), (Ids{0, 1}));
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
  EXPECT_EQ(sew(t, piece), (Ids{0, 0, 2}));
}

TEST(Sew, OfNothingIsNothing) {
  EXPECT_TRUE(sew({}, {}).empty());
}

}  // namespace
}  // namespace copse
