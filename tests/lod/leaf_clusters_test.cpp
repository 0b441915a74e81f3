#include "lib/analysis/lod/leaf_clusters.h"

#include "lib/formats/random.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

Patch leaf_at(const Double3& c, double size = 0.1, double seen = 1) {
  return patch_of({{c, c + Double3{size, 0, 0}, c + Double3{0, size, 0}}}, 1, seen);
}

std::vector<Patch> cloud(std::size_t n) {
  std::vector<Patch> out;
  const Random root(7);
  for (std::size_t i = 0; i < n; ++i) {
    Random draw = root.fork(i);
    out.push_back(leaf_at({draw.uniform(), draw.uniform(), draw.uniform()}, 0.01));
  }
  return out;
}

// Every node is merged once, and exists before it is.
void expect_tree(const std::vector<PatchMerge>& merges, std::size_t n) {
  ASSERT_EQ(merges.size() + 1, n);
  std::vector<int> used(2 * n - 1, 0);
  for (std::size_t i = 0; i < merges.size(); ++i) {
    EXPECT_LT(merges[i].a, merges[i].b);
    ASSERT_LT(merges[i].b, n + i);
    ++used[merges[i].a], ++used[merges[i].b];
  }
  EXPECT_TRUE(std::all_of(used.begin(), used.end() - 1, [](int u) { return u == 1; }));
}

TEST(LeafClusters, MergesAllIntoOne) {
  for (const std::size_t n : {1u, 2u, 3u, 100u, 1000u})
    expect_tree(cluster_leaves(cloud(n), std::vector<std::uint32_t>(n, 0), {}), n);
}

TEST(LeafClusters, OfNothingIsNothing) {
  EXPECT_TRUE(cluster_leaves({}, {}, {}).empty());
}

TEST(LeafClusters, CostsNeverFallTowardTheRoot) {
  const auto merges = cluster_leaves(cloud(500), std::vector<std::uint32_t>(500, 0), {});
  for (const PatchMerge& m : merges)
    for (const std::uint32_t child : {m.a, m.b})
      if (child >= 500) {
        EXPECT_GE(m.cost, merges[child - 500].cost);
      }
}

TEST(LeafClusters, MergesNeighboursBeforeStrangers) {
  const std::vector<Patch> leaves{leaf_at({0, 0, 0}), leaf_at({5, 0, 0}), leaf_at({0.1, 0, 0}),
                                  leaf_at({5.1, 0, 0})};
  const auto merges = cluster_leaves(leaves, std::vector<std::uint32_t>(4, 0), {});
  EXPECT_EQ(merges[0].a, 0u);
  EXPECT_EQ(merges[0].b, 2u);
  EXPECT_EQ(merges[1].a, 1u);
  EXPECT_EQ(merges[1].b, 3u);
}

TEST(LeafClusters, GroupsBecomeOneBeforeTheyAreMerged) {
  const std::size_t n = 300;
  std::vector<std::uint32_t> groups(n);
  for (std::uint32_t i = 0; i < n; ++i) groups[i] = i % 7;
  const auto merges = cluster_leaves(cloud(n), groups, {});
  expect_tree(merges, n);
  std::vector<std::uint32_t> of(groups);
  std::size_t across = 0;
  for (const PatchMerge& m : merges) {
    across += of[m.a] != of[m.b];
    if (of[m.a] == of[m.b]) {
      EXPECT_EQ(across, 0u) << "inside a group after a merge of groups";
    }
    of.push_back(of[m.a]);
  }
  EXPECT_EQ(across, 6u);
}

TEST(LeafClusters, WhatNoOneSeesGoesFirst) {
  const std::vector<Patch> leaves{leaf_at({0, 0, 0}, 0.1, 1), leaf_at({0.2, 0, 0}, 0.1, 1),
                                  leaf_at({5, 0, 0}, 0.1, 0.001), leaf_at({5.4, 0, 0}, 0.1, 0.001)};
  const auto merges = cluster_leaves(leaves, std::vector<std::uint32_t>(4, 0), {});
  const auto cost_of = [&](std::uint32_t a) {
    return std::find_if(merges.begin(), merges.end(), [&](const PatchMerge& m) { return m.a == a; })->cost;
  };
  EXPECT_LT(cost_of(2), cost_of(0));
}

TEST(LeafClusters, KeepsWithinTheLargestAreaWhileItCan) {
  const std::size_t n = 64;
  ClusterOptions options;
  options.largest = 4.5 * cloud(1)[0].area;
  const auto merges = cluster_leaves(cloud(n), std::vector<std::uint32_t>(n, 0), options);
  expect_tree(merges, n);
  std::vector<double> area(n, cloud(1)[0].area);
  std::size_t within = 0;
  for (const PatchMerge& m : merges) {
    area.push_back(area[m.a] + area[m.b]);
    within += area.back() <= options.largest;
  }
  EXPECT_GE(within, n / 2);
  for (std::size_t i = 0; i < within; ++i) EXPECT_LE(area[n + i], options.largest) << i;
}

TEST(LeafClusters, LeavesInOnePlaceOrWithoutAreaAreMergedAllTheSame) {
  expect_tree(
      cluster_leaves(std::vector<Patch>(50, leaf_at({1, 1, 1})), std::vector<std::uint32_t>(50, 0), {}), 50);
  expect_tree(
      cluster_leaves(std::vector<Patch>(50, leaf_at({1, 1, 1}, 0)), std::vector<std::uint32_t>(50, 0), {}),
      50);
}

TEST(LeafClusters, DistancesThatGrowAlongTheOrderDoNotMakeItQuadratic) {
  std::vector<Patch> leaves;
  for (int i = 0; i < 20000; ++i) leaves.push_back(leaf_at({std::pow(1.001, i), 0, 0}));
  const auto start = std::chrono::steady_clock::now();
  expect_tree(cluster_leaves(leaves, std::vector<std::uint32_t>(leaves.size(), 0), {}), leaves.size());
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10))
      << "quadratic would be minutes";
}

}  // namespace
}  // namespace copse
