#include "lib/analysis/ecosystem/jittered_cells.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

namespace copse {
namespace {

using Counts = std::vector<std::uint64_t>;

TEST(JitteredCells, TheSideIsTheSmallestWhoseSquareHoldsAll) {
  EXPECT_EQ(cells_a_side(0), 0u);
  EXPECT_EQ(cells_a_side(1), 1u);
  EXPECT_EQ(cells_a_side(4), 2u);
  EXPECT_EQ(cells_a_side(5), 3u);
  EXPECT_EQ(cells_a_side(1000000), 1000u);
  EXPECT_EQ(cells_a_side(1000001), 1001u);
  EXPECT_EQ(cells_a_side((std::uint64_t{1} << 40) - 1), std::uint64_t{1} << 20);
}

TEST(JitteredCells, CountsAreKeptAndNoCellIsUsedTwice) {
  for (const Counts& counts : {Counts{}, Counts{0}, Counts{1}, Counts{0, 7, 0, 2}, Counts{16},
                               Counts{500, 300, 199, 1}, Counts{1, 9999}}) {
    const std::uint64_t total = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
    const std::uint64_t side = std::max<std::uint64_t>(cells_a_side(total), 1);
    const CellPlaces places = place_in_cells(counts, side * side, Random(1));
    EXPECT_EQ(places.cells.size(), total);
    EXPECT_EQ(std::set<std::uint64_t>(places.cells.begin(), places.cells.end()).size(), total);
    for (const std::uint64_t c : places.cells) EXPECT_LT(c, side * side);
  }
}

// Erratum E5: were the walk not begun anew, the second type would be thrown in at random.
TEST(JitteredCells, EveryTypeWalksTheWholeGrid) {
  const CellPlaces places = place_in_cells(Counts{1000, 1000, 1000}, 100 * 100, Random(3));
  for (std::size_t t = 0; t < 3; ++t) {
    Counts tenths(10);
    for (std::size_t i = 0; i < 1000; ++i) ++tenths[places.cells[1000 * t + i] / 1000];
    for (const std::uint64_t n : tenths) EXPECT_NEAR(static_cast<double>(n), 100, 12) << t;
  }
  EXPECT_LT(places.at_random, 40u);
}

// Chi-square of a type's instances over 16 x 16 blocks of cells, against uniform at random: a jittered walk
// is far more even, so the bound is the lower tail's upper end as well.
TEST(JitteredCells, ATypeIsSpreadMoreEvenlyThanChance) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const CellPlaces places = place_in_cells(Counts{4096, 12288}, 128 * 128, Random(seed));
    std::vector<double> blocks(256);
    for (std::size_t i = 0; i < 4096; ++i)
      blocks[places.cells[i] / 128 / 8 * 16 + places.cells[i] % 128 / 8] += 1;
    double chi = 0;
    for (const double n : blocks) chi += (n - 16) * (n - 16) / 16;
    EXPECT_LT(chi, 310.5) << seed;  // 99 % of chi-square with 255 degrees of freedom
  }
}

TEST(JitteredCells, ASingleInstanceMayStandAnywhere) {
  std::set<std::uint64_t> seen;
  for (std::uint64_t seed = 0; seed < 400; ++seed)
    seen.insert(place_in_cells(Counts{1}, 9, Random(seed)).cells[0]);
  EXPECT_GE(seen.size(), 7u);
}

TEST(JitteredCells, AMillionTakeLittleTime) {
  const CellPlaces places = place_in_cells(Counts(8, 125000), 1000 * 1000, Random(4));
  EXPECT_EQ(places.cells.size(), 1000000u);
  std::vector<bool> used(1000000);
  for (const std::uint64_t c : places.cells) {
    EXPECT_FALSE(used[c]);
    used[c] = true;
  }
}

}  // namespace
}  // namespace copse
