#include "lib/formats/random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(Random, GivesTheSameNumbersEverywhere) {
  Random random(42);
  const std::array<std::uint64_t, 3> first{random.next(), random.next(), random.next()};
  Random again(42);
  EXPECT_EQ(first, (std::array<std::uint64_t, 3>{again.next(), again.next(), again.next()}));
  EXPECT_EQ(Random::mix(1), 0x5692161d100b05e5u);  // the finalizer as published
}

TEST(Random, AForkDoesNotDependOnHowFarItsParentHasGone) {
  Random a(7), b(7);
  for (int i = 0; i < 100; ++i) b.next();
  EXPECT_EQ(a.fork(3).next(), b.fork(3).next());
}

TEST(Random, ForksSeedsAndParentsAllDiffer) {
  std::set<std::uint64_t> seen;
  std::size_t drawn = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Random random(seed);
    for (std::uint64_t key = 0; key < 50; ++key) {
      Random child = random.fork(key);
      for (int i = 0; i < 4; ++i) seen.insert(child.next()), ++drawn;
    }
    for (int i = 0; i < 4; ++i) seen.insert(random.next()), ++drawn;
  }
  EXPECT_EQ(seen.size(), drawn);
}

TEST(Random, UniformFillsItsRangeEvenly) {
  Random random(1);
  std::array<int, 16> bins{};
  double sum = 0;
  constexpr int k_count = 160000;
  for (int i = 0; i < k_count; ++i) {
    const double x = random.uniform();
    ASSERT_GE(x, 0);
    ASSERT_LT(x, 1);
    sum += x;
    ++bins[static_cast<std::size_t>(x * 16)];
  }
  EXPECT_NEAR(sum / k_count, 0.5, 0.005);
  for (const int n : bins) EXPECT_NEAR(n, k_count / 16, 500);  // 5 sigma
}

TEST(Random, BelowReachesEveryValueAndNothingElse) {
  Random random(2);
  std::array<int, 7> counts{};
  for (int i = 0; i < 70000; ++i) ++counts.at(random.below(7));
  for (const int n : counts) EXPECT_NEAR(n, 10000, 500);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(random.below(1), 0u);
  for (int i = 0; i < 10; ++i) EXPECT_LT(random.below(0xc000000000000000u), 0xc000000000000000u);
}

TEST(Random, RoundKeepsTheMean) {
  Random random(3);
  double sum = 0;
  for (int i = 0; i < 100000; ++i) sum += static_cast<double>(random.round(-2.25));
  EXPECT_NEAR(sum / 100000, -2.25, 0.01);
  EXPECT_EQ(random.round(5), 5);
}

TEST(Random, ShufflePermutes) {
  Random random(4);
  std::vector<int> v(100);
  std::iota(v.begin(), v.end(), 0);
  std::vector<int> shuffled = v;
  random.shuffle(std::span(shuffled));
  EXPECT_NE(v, shuffled);
  std::sort(shuffled.begin(), shuffled.end());
  EXPECT_EQ(v, shuffled);
}

}  // namespace
}  // namespace copse
