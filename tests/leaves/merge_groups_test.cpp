#include "lib/analysis/leaves/merge_groups.h"

#include "lib/formats/random.h"

#include <chrono>
#include <numeric>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace copse {
namespace {

using testing::Each;
using testing::ElementsAre;
using Indices = std::vector<std::uint32_t>;

TEST(MergeGroups, LeavesGroupsAloneThatAreFewEnough) {
  EXPECT_THAT(merge_groups(std::vector<Double3>{{0, 0, 0}, {1, 0, 0}}, Indices{1, 1}, 2), ElementsAre(0, 1));
  EXPECT_TRUE(merge_groups({}, {}, 1).empty());
}

TEST(MergeGroups, TheSmallestJoinsItsNearest) {
  const std::vector<Double3> centres{{0, 0, 0}, {1, 0, 0}, {5, 0, 0}};
  EXPECT_THAT(merge_groups(centres, Indices{9, 1, 5}, 2), ElementsAre(0, 0, 2));
  EXPECT_THAT(merge_groups(centres, Indices{9, 7, 5}, 2), ElementsAre(0, 1, 1));
}

TEST(MergeGroups, WhatWasJoinedCountsAllItsLeaves) {
  // 1 joins 0; then 2 (4 leaves) is smaller than 0 with 1 (5) and joins it; 3 is never touched.
  const std::vector<Double3> centres{{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {100, 0, 0}};
  EXPECT_THAT(merge_groups(centres, Indices{3, 2, 4, 6}, 2), ElementsAre(0, 0, 0, 3));
}

TEST(MergeGroups, TiesGoToTheLowest) {
  const std::vector<Double3> centres{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  EXPECT_THAT(merge_groups(centres, Indices{2, 2, 2}, 2), ElementsAre(1, 1, 2));
  EXPECT_THAT(merge_groups(centres, Indices{2, 1, 2}, 2), ElementsAre(0, 0, 2));
}

TEST(MergeGroups, ALimitOfOnePutsAllIntoOne) {
  const Indices into = merge_groups(std::vector<Double3>(9, Double3{1, 1, 1}), Indices(9, 4), 1);
  EXPECT_THAT(into, Each(into[0]));
}

TEST(MergeGroups, AgreesWithTheRuleTakenLiterally) {
  Random random(3);
  for (int round = 0; round < 20; ++round) {
    std::vector<Double3> centres;
    Indices leaves;
    for (int i = 0; i < 60; ++i) {
      centres.push_back({double(random.below(6)), double(random.below(6)), random.uniform()});
      leaves.push_back(static_cast<std::uint32_t>(1 + random.below(9)));
    }
    Indices into(centres.size()), size = leaves;
    std::iota(into.begin(), into.end(), 0u);
    std::set<std::uint32_t> left(into.begin(), into.end());
    while (left.size() > 7) {
      const std::uint32_t small = *std::min_element(left.begin(), left.end(), [&](auto a, auto b) {
        return std::pair(size[a], a) < std::pair(size[b], b);
      });
      left.erase(small);
      const auto d = [&](std::uint32_t g) {
        const Double3 e = centres[g] - centres[small];
        return std::pair(dot(e, e), g);
      };
      const std::uint32_t to =
          *std::min_element(left.begin(), left.end(), [&](auto a, auto b) { return d(a) < d(b); });
      size[to] += size[small];
      for (std::uint32_t& g : into) g = g == small ? to : g;
    }
    ASSERT_EQ(merge_groups(centres, leaves, 7), into);
  }
}

TEST(MergeGroups, AHundredThousandTakeNoTime) {
  Random random(4);
  std::vector<Double3> centres;
  for (int i = 0; i < 100000; ++i) centres.push_back({random.uniform(), random.uniform(), random.uniform()});
  const auto start = std::chrono::steady_clock::now();
  const Indices into = merge_groups(centres, Indices(centres.size(), 1), 100);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_EQ(std::set<std::uint32_t>(into.begin(), into.end()).size(), 100u);
  std::printf("  merge_groups: %.2f s for 100 000 groups into 100\n", seconds);
  EXPECT_LT(seconds, 20);
}

}  // namespace
}  // namespace copse
