#include "lib/analysis/skeleton/valleys.h"

#include "tests/skeleton/united_boxes.h"
#include "tests/trunk/welded_meshes.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(Valleys, DivideAUnionIntoItsTubes) {
  const Surface s = surface_of(united_boxes());
  const CutSurface cut = cut_along_valleys(s, bands_of_boxes(s), 0.17);
  EXPECT_EQ(cut.pieces, 2u);
  EXPECT_EQ(cut.valleys, 1u);
  // The six corners of the valley are each piece's own.
  EXPECT_EQ(cut.origin.size(), s.positions.size() + 6);
  EXPECT_EQ(std::ranges::count(cut.at_valley, 1), 12);
}

TEST(Valleys, AreNotFoundOnAConvexSurface) {
  const Surface s = surface_of(united_boxes(false));
  const CutSurface cut = cut_along_valleys(s, bands_of_boxes(s, false), 0.17);
  EXPECT_EQ(cut.pieces, 1u);
  EXPECT_EQ(cut.valleys, 0u);
}

}  // namespace
}  // namespace copse
