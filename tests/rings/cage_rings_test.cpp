#include "lib/analysis/rings/cage_rings.h"

#include "tests/rings/cages.h"

#include <algorithm>
#include <utility>

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(CageRings, FindsTheEndsThatMeetAtAFork) {
  const Fork fork;
  const CageRings c = read_cage_rings(fork.m.cage);
  EXPECT_EQ(c.bands.count(), 9u);
  ASSERT_EQ(c.ends_of.count(), 1u);
  EXPECT_EQ(c.ends_of[0].size(), 3u);
  for (const std::uint32_t end : c.ends_of[0]) {
    EXPECT_EQ(c.fork_of[end], 0u);
    EXPECT_TRUE(c.is_regular(c.graph.node_of[end]));
  }
  EXPECT_EQ(std::ranges::count(c.fork_of, 0u), 3);
  EXPECT_EQ(std::ranges::count(c.is_hull, 1), 0);
}

// Two limbs whose first rings were merged corner by corner: from there two bands lead on and the hull back.
TEST(CageRings, TakesTheBandThatLeadsBackFromMergedRingsForTheHull) {
  Maker m;
  const auto below = m.ring({0, 0, 0}, {0, 1, 0}, 1), trunk = m.ring({0, -3, 0}, {0, 1, 0}, 1);
  const auto merged = m.ring({0, 2, 0}, {0, 1, 0}, 1);
  const auto left = m.ring({-1, 5, 0}, {-0.3, 1, 0}, 1), right = m.ring({1, 5, 0}, {0.3, 1, 0}, 1);
  for (const auto& [a, b] :
       {std::pair(trunk, below), std::pair(below, merged), std::pair(merged, left), std::pair(merged, right)})
    m.band(a, b);
  for (const auto& end : {trunk, left, right}) m.face(end);
  const CageRings c = read_cage_rings(m.cage);
  ASSERT_EQ(c.ends_of.count(), 1u);
  ASSERT_EQ(std::ranges::count(c.is_hull, 1), 1);
  const auto hull = static_cast<std::uint32_t>(std::ranges::find(c.is_hull, 1) - c.is_hull.begin());
  double low = 1e9, high = -1e9;
  for (const std::uint32_t end : {2 * hull, 2 * hull + 1}) {
    low = std::min(low, c.graph.circle[c.graph.node_of[end]].centre.y);
    high = std::max(high, c.graph.circle[c.graph.node_of[end]].centre.y);
  }
  EXPECT_EQ(std::pair(low, high), std::pair(0.0, 2.0));
  EXPECT_EQ(c.ends_of[0].size(), 3u);
}

// All that a hull has is moved towards its neighbours along its edges, and comes back.
TEST(CageRings, UndoesTheSmoothingOfHulls) {
  const Fork fork;
  Fork moved;
  std::vector<std::vector<std::uint32_t>> beside(8);
  for (std::uint32_t f = 0; f < moved.m.cage.faces.count(); ++f) {
    const auto corners = moved.m.cage.faces[f];
    if (std::ranges::any_of(corners, [](std::uint32_t v) { return v >= 8; })) continue;
    for (std::size_t i = 0; i < 4; ++i) {
      for (const std::size_t k : {(i + 1) % 4, (i + 3) % 4}) {
        auto& list = beside[corners[i]];
        if (std::ranges::count(list, corners[k]) == 0) list.push_back(corners[k]);
      }
    }
  }
  for (std::uint32_t v = 0; v < 8; ++v) {
    Double3 sum = fork.m.cage.positions[v];
    for (const std::uint32_t n : beside[v]) sum += fork.m.cage.positions[n];
    const Double3 mean = sum / static_cast<double>(beside[v].size() + 1);
    moved.m.cage.positions[v] += (mean - fork.m.cage.positions[v]) * (0.6 / 2);
  }
  const CageRings c = read_cage_rings(moved.m.cage);
  for (std::uint32_t v = 0; v < 8; ++v)
    EXPECT_LT(distance(c.surface.positions[c.local[v]], fork.m.cage.positions[v]), 1e-6) << v;
  for (const std::uint32_t end : c.ends_of[0]) EXPECT_TRUE(c.is_regular(c.graph.node_of[end]));
}

TEST(CageRings, HasNoneOfNothing) {
  const CageRings c = read_cage_rings({});
  EXPECT_EQ(c.bands.count(), 0u);
  EXPECT_EQ(c.ends_of.count(), 0u);
}

}  // namespace
}  // namespace copse
