#include "lib/analysis/lod/limb_leaves.h"

#include "lib/analysis/lod/limb_ladder.h"
#include "tests/lod/tube_tree.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

namespace copse {
namespace {

// A twig that bends aside by `bow` metres in its middle, and leaves of half a square metre at some rings.
Tree twig(const std::vector<std::uint32_t>& leaves_at, double bow) {
  constexpr int k_rings = 17;
  Tube tube;
  std::uint32_t before = k_none;
  std::vector<Double3> places;
  for (int i = 0; i < k_rings; ++i) {
    places.push_back({bow * std::sin(3.14159265358979 * i / (k_rings - 1)), 0.5 * i, 0});
    before = tube.add_ring(places.back(), 0.02, 4, before);
  }
  Tree tree = tree_of(tube);
  std::vector<Float3> vertices;
  std::vector<CornerTriangle> triangles;
  std::vector<std::uint32_t> order;
  for (const std::uint32_t ring : leaves_at) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (const Double3 corner : {Double3{-1, 0, 0.1}, Double3{1, 0, 0.1}, Double3{0, 0.5, 0.1}})
      vertices.push_back(to_float(places[ring] + corner));
    order.push_back(static_cast<std::uint32_t>(triangles.size()));
    triangles.push_back({.vertex = {first, first + 1, first + 2},
                         .normal = {k_none, k_none, k_none},
                         .texcoord = {k_none, k_none, k_none}});
  }
  tree.header.leaf_factor = 1;
  tree.leaves.vertices = vertices, tree.leaves.triangles = triangles, tree.leaves.order = order;
  const LeafGroup group{.first = 0, .count = static_cast<std::uint32_t>(order.size())};
  tree.leaves.groups = std::vector<LeafGroup>{group};
  std::vector<Radius> radii = tree.hierarchy.radii.to_vector();
  radii.back().first_child = 0, radii.back().child_count = 1;
  tree.hierarchy.radii = radii;
  return tree;
}

TEST(LimbLeaves, AreaIsAtTheNearestRing) {
  const Tree tree = twig({3, 8, 8, 16}, 0.4);
  const auto leaves = limb_leaves(tree, limb_chains(tree), absolute_centres(tree));
  ASSERT_EQ(leaves.size(), 1u);
  ASSERT_EQ(leaves[0].size(), 17u);
  EXPECT_NEAR(leaves[0][3], 0.5, 1e-6);
  EXPECT_NEAR(leaves[0][8], 1.0, 1e-6);
  EXPECT_NEAR(leaves[0][16], 0.5, 1e-6);
  EXPECT_NEAR(std::accumulate(leaves[0].begin(), leaves[0].end(), 0.0), 2.0, 1e-6);
}

TEST(LimbLeaves, ALimbThatBearsNoneHasNoList) {
  const Tree tree = stem_with_twigs(6, 8, 3);
  for (const auto& list : limb_leaves(tree, limb_chains(tree), absolute_centres(tree)))
    EXPECT_TRUE(list.empty());
}

std::vector<LimbRung> ladder_of(const Tree& tree, double hold) {
  const std::vector<Double3> centres = absolute_centres(tree);
  const PartTriangles trunk = trunk_triangles(tree);
  const std::vector<LimbChain> limbs = limb_chains(tree);
  const auto leaves = limb_leaves(tree, limbs, centres);
  const LimbShape shape(tree, centres, trunk, limbs[0]);
  return limb_ladder(shape, std::vector<std::uint8_t>(shape.ring_count()), 128, 6, RemovalOrder::silhouette,
                     {leaves[0], hold});
}

// The triangles of the first rung that goes straight from end to end, or is gone.
double triangles_when_straight(const std::vector<LimbRung>& ladder) {
  for (const LimbRung& rung : ladder)
    if (rung.kept.size() == 2 || rung.kept.empty()) return rung.triangles;
  return 0;
}

TEST(LimbLeaves, ATwigKeepsItsBendAsLongAsLeavesHangOnIt) {
  const Tree at_the_bend = twig({7, 8, 8, 9}, 0.4), at_the_ends = twig({0, 0, 16, 16}, 0.4);
  const double held = triangles_when_straight(ladder_of(at_the_bend, 0.1)),
               free = triangles_when_straight(ladder_of(at_the_ends, 0.1));
  EXPECT_LT(held, free) << "bent until it has fewer triangles";
}

TEST(LimbLeaves, WhatHoldsAnywayCostsNothing) {
  const std::vector<LimbRung> held = ladder_of(twig({7, 8, 8, 9}, 0.4), 0.5),
                              bare = ladder_of(twig({0}, 0.4), 0.5);
  ASSERT_EQ(held.size(), bare.size());
  for (std::size_t i = 0; i < held.size(); ++i) EXPECT_EQ(held[i].cost, bare[i].cost) << i;
}

}  // namespace
}  // namespace copse
