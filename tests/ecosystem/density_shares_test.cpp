#include "lib/analysis/ecosystem/density_shares.h"

#include "lib/formats/random.h"

#include <numbers>

#include <gtest/gtest.h>

namespace copse {
namespace {

const auto k_anywhere = [](std::uint64_t) { return GroundPlace{}; };

// 8 x 8 cells of 1 m; the eastern half is three times as dense.
DensityField halves() {
  DensityField f{{0, 0, 8, 8}, 8, 8, {}};
  for (int i = 0; i < 64; ++i) f.weights.push_back(i % 8 < 4 ? 1 : 3);
  return f;
}

TEST(DensityShares, TellsWhatEveryDensityAskedForAndGot) {
  const std::vector<GroundPlace> feet{{1, 1}, {2, 7}, {3, 3}, {5, 5}, {7, 1}, {-1, 5}};
  const std::vector<Disc> discs{{6, 6, 1}, {7.9, 0.1, 0.5}, {0, 0, 0.25}, {20, 20, 9}};
  const auto shares = density_shares(
      halves(), 6,
      [](std::uint64_t i) {
        return GroundPlace{1.0 + static_cast<double>(i), 4};
      },
      feet, discs);
  ASSERT_EQ(shares.size(), 2u);
  EXPECT_DOUBLE_EQ(shares[0].asked, 1.5);
  EXPECT_DOUBLE_EQ(shares[1].asked, 4.5);
  EXPECT_EQ(shares[0].got, 3u);
  EXPECT_EQ(shares[1].got, 2u);
  EXPECT_DOUBLE_EQ(shares[0].covered, std::numbers::pi * 0.0625 / 32);
  EXPECT_DOUBLE_EQ(shares[1].covered, std::numbers::pi * 1.25 / 32);
  EXPECT_NEAR(shares[0].to, 1 / 3.0, 0.002);
  EXPECT_EQ(shares[1].to, 1);
  EXPECT_DOUBLE_EQ(histogram_error(shares), (1.5 + 2.5) / 6);
  EXPECT_EQ(shares[0].unhindered, 3u);
  EXPECT_EQ(shares[1].unhindered, 3u);
  EXPECT_EQ(out_of_their_part(shares), 0u);  // one in the east stands nowhere
}

TEST(DensityShares, PartsHaveAboutAnEighthOfTheMassEach) {
  DensityField f{{0, 0, 1, 1}, 100, 100, {}};
  Random random(1);
  for (int i = 0; i < 10000; ++i) f.weights.push_back(random.uniform());
  const auto shares = density_shares(f, 800, k_anywhere, {}, {});
  ASSERT_EQ(shares.size(), 8u);
  double sum = 0;
  for (const DensityShare& s : shares) {
    EXPECT_NEAR(s.asked, 100, 3);
    sum += s.asked;
  }
  EXPECT_NEAR(sum, 800, 1e-9);
  EXPECT_DOUBLE_EQ(histogram_error(shares), 1);  // none stands
}

TEST(DensityShares, WhatStandsWhereItWouldNotIsCountedOnce) {
  const std::vector<GroundPlace> feet{{1, 1}, {2, 7}, {3, 3}, {5, 5}};
  const auto shares = density_shares(halves(), 4, [](std::uint64_t) { return GroundPlace{6, 6}; }, feet, {});
  EXPECT_EQ(out_of_their_part(shares), 3u);
}

TEST(DensityShares, AFieldThatIsEvenOrEmptyHasNoParts) {
  EXPECT_TRUE(density_shares({}, 5, k_anywhere, {}, {}).empty());
  EXPECT_TRUE(density_shares({{0, 0, 1, 1}, 2, 1, {0, 0}}, 5, k_anywhere, {}, {}).empty());
  EXPECT_TRUE(density_shares({{0, 0, 1, 1}, 2, 2, {0, 7, 7, 7}}, 5, k_anywhere, {}, {}).empty());
  EXPECT_EQ(histogram_error({}), 0);
}

}  // namespace
}  // namespace copse
