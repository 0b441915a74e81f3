#include "lib/analysis/ecosystem/jittered_cells.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

namespace copse {
namespace {

using Counts = std::vector<std::uint64_t>;

TEST(JitteredCells, OverASquareTheSideIsTheSmallestWhoseSquareHoldsAll) {
  for (const auto& [instances, side] : {std::pair<std::uint64_t, std::uint64_t>{1, 1},
                                        {4, 2},
                                        {5, 3},
                                        {6, 3},
                                        {1000000, 1000},
                                        {1000001, 1001},
                                        {(std::uint64_t{1} << 40) - 1, std::uint64_t{1} << 20}}) {
    const CellGrid grid = cells_over(12.5, 12.5, instances);
    EXPECT_EQ(grid.columns, side);
    EXPECT_EQ(grid.rows, side);
  }
  EXPECT_EQ(cells_over(5, 5, 0).cells(), 0u);
}

TEST(JitteredCells, OverOtherShapesTheyAreAsSquareAsTheyCanBe) {
  const CellGrid strip = cells_over(1000, 10, 500);
  EXPECT_EQ(strip.columns, 250u);
  EXPECT_EQ(strip.rows, 2u);
  EXPECT_EQ(cells_over(10, 1000, 500).columns, 2u);
  const CellGrid line = cells_over(1e9, 1e-3, 7);
  EXPECT_EQ(line.columns, 7u);
  EXPECT_EQ(line.rows, 1u);
  Random random(2);
  for (int n = 0; n < 2000; ++n) {
    const double width = random.uniform(1, 100), depth = random.uniform(1, 100);
    const std::uint64_t count = 1 + random.below(5000);
    const CellGrid grid = cells_over(width, depth, count);
    EXPECT_GE(grid.cells(), count);
    EXPECT_LT(grid.cells(), 5 * count);
    // No grid of square cells has larger ones.
    const double cell = std::min(width / static_cast<double>(grid.columns),
                                 depth / static_cast<double>(grid.rows)),
                 larger = cell * 1.001;
    EXPECT_LT(std::floor(width / larger) * std::floor(depth / larger), static_cast<double>(count)) << n;
  }
}

TEST(JitteredCells, CountsAreKeptAndNoCellIsUsedTwice) {
  for (const Counts& counts : {Counts{}, Counts{0}, Counts{1}, Counts{0, 7, 0, 2}, Counts{16},
                               Counts{500, 300, 199, 1}, Counts{1, 9999}}) {
    const std::uint64_t total = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
    const std::uint64_t cells = cells_over(3, 2, total).cells();
    const CellPlaces places = place_in_cells(counts, cells, Random(1));
    EXPECT_EQ(places.cells.size(), total);
    EXPECT_EQ(std::set<std::uint64_t>(places.cells.begin(), places.cells.end()).size(), total);
    for (const std::uint64_t c : places.cells) EXPECT_LT(c, cells);
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
