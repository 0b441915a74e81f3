#include "lib/analysis/ecosystem/hilbert_curve.h"

#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(HilbertCurve, VisitsEveryCellOnceAndStepsToANeighbour) {
  for (std::uint32_t bits = 0; bits <= 6; ++bits) {
    const std::uint32_t side = 1u << bits;
    std::vector<bool> seen(std::size_t{side} * side);
    GridCell before;
    for (std::uint64_t i = 0; i < std::uint64_t{side} * side; ++i) {
      const GridCell c = hilbert_cell(i, bits);
      ASSERT_LT(c.x, side);
      ASSERT_LT(c.y, side);
      EXPECT_FALSE(seen[c.y * side + c.x]);
      seen[c.y * side + c.x] = true;
      EXPECT_EQ(hilbert_index(c.x, c.y, bits), i);
      if (i > 0) {
        EXPECT_EQ(std::abs(static_cast<int>(c.x) - static_cast<int>(before.x)) +
                      std::abs(static_cast<int>(c.y) - static_cast<int>(before.y)),
                  1);
      }
      before = c;
    }
  }
}

TEST(HilbertCurve, ATileIsTheCellsOfItsPartOfTheCurve) {
  for (const std::uint32_t bits : {4u, 5u, 7u})
    for (std::uint64_t tile = 0; tile < std::uint64_t{1} << (2 * bits - 8); ++tile) {
      const auto cells = hilbert_tile(tile, bits);
      for (std::uint64_t i = 0; i < 256; ++i) {
        const GridCell c = hilbert_cell(256 * tile + i, bits);
        ASSERT_EQ(cells[i].x, c.x);
        ASSERT_EQ(cells[i].y, c.y);
      }
    }
}

TEST(HilbertCurve, AFinerCurveRefinesACoarserOne) {
  for (std::uint32_t y = 0; y < 64; ++y)
    for (std::uint32_t x = 0; x < 64; ++x)
      EXPECT_EQ(hilbert_index(x, y, 6) >> 4, hilbert_index(x >> 2, y >> 2, 4));
}

}  // namespace
}  // namespace copse
