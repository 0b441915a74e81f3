#include "lib/analysis/lod/leaf_matching.h"

#include "lib/formats/random.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

MatchLeaf leaf_at(const Double3& c, double sole = 10, double seen = 10) {
  return {c, {0, 1, 0}, 0.01, 20, sole, seen, 0};
}

std::vector<MatchLeaf> cloud(std::size_t n) {
  std::vector<MatchLeaf> out;
  const Random root(7);
  for (std::size_t i = 0; i < n; ++i) {
    Random draw = root.fork(i);
    out.push_back(leaf_at({draw.uniform(), draw.uniform(), draw.uniform()}, 20 * draw.uniform()));
  }
  return out;
}

std::size_t expect_disjoint(const std::vector<LeafMatch>& matches, std::size_t leaves) {
  std::vector<int> used(leaves);
  std::size_t guests = 0;
  for (const LeafMatch& m : matches) {
    EXPECT_FALSE(m.guests.empty());
    ++used[m.host], guests += m.guests.size();
    for (const std::uint32_t g : m.guests) ++used[g];
  }
  EXPECT_TRUE(std::all_of(used.begin(), used.end(), [](int u) { return u <= 1; }));
  return guests;
}

TEST(LeafMatching, TakesAsManyAsAreAskedForAndEachLeafOnce) {
  for (const std::size_t most : {1u, 10u, 50u}) {
    MatchOptions options;
    options.most = most;
    EXPECT_EQ(expect_disjoint(match_leaves(cloud(500), options), 500), most);
  }
}

TEST(LeafMatching, OfFewerThanTwoThereIsNone) {
  EXPECT_TRUE(match_leaves({}, {}).empty());
  EXPECT_TRUE(match_leaves(cloud(1), {}).empty());
  EXPECT_EQ(match_leaves(cloud(2), {}).size(), 1u);
}

TEST(LeafMatching, WhatNoOneSeesGoesFirst) {
  const std::vector<MatchLeaf> leaves{leaf_at({0, 0, 0}), leaf_at({0.1, 0, 0}), leaf_at({5, 0, 0}, 0, 0),
                                      leaf_at({5.1, 0, 0}, 0, 0)};
  const auto matches = match_leaves(leaves, {});
  ASSERT_EQ(matches.size(), 1u);
  EXPECT_GE(matches[0].host, 2u);
  EXPECT_GE(matches[0].guests[0], 2u);
}

TEST(LeafMatching, TheOneThatIsSeenStays) {
  const std::vector<MatchLeaf> leaves{leaf_at({0, 0, 0}, 0, 1), leaf_at({1, 0, 0}, 0, 20)};
  const auto matches = match_leaves(leaves, {});
  ASSERT_EQ(matches.size(), 1u);
  EXPECT_EQ(matches[0].host, 1u);
}

TEST(LeafMatching, OfEqualsNeighboursAreMatched) {
  const std::vector<MatchLeaf> leaves{leaf_at({0, 0, 0}), leaf_at({5, 0, 0}), leaf_at({0.1, 0, 0}),
                                      leaf_at({5.1, 0, 0})};
  MatchOptions options;
  options.most = 2, options.guests = 1;
  for (const LeafMatch& m : match_leaves(leaves, options)) EXPECT_EQ(m.host % 2, m.guests[0] % 2);
}

TEST(LeafMatching, CoresTakeGuestsFromEverywhereAsLongAsThereIsRoom) {
  std::vector<MatchLeaf> leaves = cloud(400);
  for (MatchLeaf& l : leaves) l.sole = 0, l.seen = 4;
  leaves[17].seen = 0;
  MatchOptions options;
  options.most = 100, options.largest = 1, options.cores = 1, options.core = 0.2, options.room = 0.155;
  const auto matches = match_leaves(leaves, options);
  expect_disjoint(matches, leaves.size());
  const auto core = std::find_if(matches.begin(), matches.end(), [](const LeafMatch& m) { return m.core; });
  ASSERT_NE(core, matches.end());
  EXPECT_EQ(core->host, 17u);
  EXPECT_GE(core->guests.size(), 15u) << "of 0.01 m² each";
  EXPECT_LE(core->guests.size(), 15u + options.guests) << "with some of its neighbours";
  options.room = 0;
  for (const LeafMatch& m : match_leaves(leaves, options)) EXPECT_FALSE(m.core);
}

TEST(LeafMatching, ACoreTakesNoMoreThanItHolds) {
  std::vector<MatchLeaf> leaves = cloud(400);
  for (MatchLeaf& l : leaves) l.sole = 0, l.seen = 4;
  leaves[17].seen = 0;
  MatchOptions options;
  options.most = 100, options.largest = 1, options.cores = 1, options.core = 0.2, options.room = 1;
  options.holds = [](std::uint32_t leaf) { return leaf == 17 ? 0.055 : 1; };
  for (const LeafMatch& m : match_leaves(leaves, options))
    EXPECT_TRUE(!m.core || m.guests.size() == 4) << "of 0.01 m² each, beside its own";
  options.holds = [](std::uint32_t leaf) { return leaf == 17 ? 0.0 : 1; };
  for (const LeafMatch& m : match_leaves(leaves, options)) EXPECT_TRUE(!m.core || m.host != 17);
}

TEST(LeafMatching, ThoseWhoseFirstHostIsGoneAskAnother) {
  std::vector<MatchLeaf> leaves = cloud(1000);
  MatchOptions options;
  options.most = 300;
  EXPECT_EQ(expect_disjoint(match_leaves(leaves, options), leaves.size()), 300u);
}

TEST(LeafMatching, NeighboursInTheOrderOfTheCurveAreNear) {
  std::vector<Double3> points;
  for (const MatchLeaf& l : cloud(4096)) points.push_back(l.centre);
  const std::vector<std::uint32_t> order = curve_order(points);
  std::vector<std::uint32_t> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  double along = 0, across = 0;
  for (std::uint32_t i = 0; i < 4096; ++i) EXPECT_EQ(sorted[i], i);
  for (std::uint32_t i = 1; i < 4096; ++i)
    along += distance(points[order[i - 1]], points[order[i]]), across += distance(points[i - 1], points[i]);
  EXPECT_LT(5 * along, across);
  EXPECT_TRUE(curve_order({}).empty());
}

TEST(LeafMatching, KeepsWithinTheLargestAreaWhileItCan) {
  const std::vector<MatchLeaf> leaves = cloud(64);
  MatchOptions options;
  options.most = 64, options.largest = 0.035, options.guests = 8;
  for (const LeafMatch& m : match_leaves(leaves, options)) EXPECT_LE(m.guests.size(), 2u);
  options.largest = 0.015;
  EXPECT_FALSE(match_leaves(leaves, options).empty()) << "nothing fits, and yet it goes on";
}

TEST(LeafMatching, LeavesInOnePlaceOrWithoutAreaAreMatchedAllTheSame) {
  MatchLeaf nothing;
  EXPECT_FALSE(match_leaves(std::vector<MatchLeaf>(50, nothing), {}).empty());
  EXPECT_FALSE(match_leaves(std::vector<MatchLeaf>(50, leaf_at({1, 1, 1})), {}).empty());
}

TEST(LeafMatching, DistancesThatGrowAlongTheOrderDoNotMakeItQuadratic) {
  std::vector<MatchLeaf> leaves;
  for (int i = 0; i < 20000; ++i) leaves.push_back(leaf_at({std::pow(1.001, i), 0, 0}));
  MatchOptions options;
  options.most = leaves.size();
  const auto start = std::chrono::steady_clock::now();
  EXPECT_GE(expect_disjoint(match_leaves(leaves, options), leaves.size()), leaves.size() / 64);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10))
      << "quadratic would be minutes";
}

}  // namespace
}  // namespace copse
