#include "lib/analysis/rings/ring_walk.h"

#include "lib/analysis/rings/fork_rings.h"
#include "tests/trunk/welded_meshes.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

Hierarchy walk(const TrunkMesh& mesh) {
  const Surface s = surface_of(mesh);
  const Bands bands = read_bands(s);
  return walk_rings(s, bands, make_ring_graph(s, bands));
}

TEST(RingWalk, StartsAtTheThickAndLowEnd) {
  const Double3 axis[] = {{0, 3, 0}, {0, 2, 0}, {0, 1, 0}, {0, 0, 0}};
  const double tapering[] = {0.2, 0.4, 0.8, 1};
  EXPECT_EQ(walk(tube(axis, tapering, 6, false)).radii[0].centre.y, 0);
  const double even[] = {1, 1, 1, 1};
  EXPECT_EQ(walk(tube(axis, even, 6, false)).radii[0].centre.y, 0);
  const double hanging[] = {1, 0.8, 0.4, 0.2};
  EXPECT_EQ(walk(tube(axis, hanging, 6, false)).radii[0].centre.y, 3);
}

TEST(RingWalk, CarriesABranchOnAlongItsThickestLimb) {
  const WeldedMesh tree = fork_tree({.depth = 5, .twist = 0});
  const Hierarchy h = walk(tree.mesh);
  for (std::uint32_t r = 1; r < h.radii.size(); ++r) {
    if (h.radii[r].branch != h.radii[h.radii[r].parent].branch) continue;
    for (std::uint32_t q = 1; q < h.radii.size(); ++q) {
      if (q == r || h.radii[q].parent != h.radii[r].parent) continue;
      EXPECT_NE(h.radii[q].branch, h.radii[r].branch);
    }
  }
}

TEST(RingWalk, MakesACapNoRadiusButExplainsIt) {
  const Double3 axis[] = {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}};
  const double radii[] = {1, 1, 1};
  const Hierarchy h = walk(tube(axis, radii, 8, true));
  EXPECT_EQ(h.radii.size(), 3u);
  EXPECT_EQ(std::ranges::count(h.segment_of, k_none), 0);
}

TEST(RingWalk, MakesAPointARadiusWithoutDiameter) {
  const Hierarchy h = walk(fork_tree({.depth = 1}).mesh);
  std::size_t points = 0;
  for (const RadiusNode& r : h.radii) {
    if (r.source != RadiusSource::point) continue;
    ++points;
    EXPECT_EQ(r.diameter, 0);
  }
  EXPECT_EQ(points, 2u);
}

TEST(RingWalk, PutsARadiusBetweenLimbsThatMeetRoundLooseVertices) {
  // The corner between the three sides of the middle cell that no limb grows from is far from every ring.
  std::vector<Cell> cells;
  for (int y = 0; y < 5; ++y) cells.push_back({0, y, 0});
  for (int i = 1; i < 6; ++i) cells.push_back({i, 4, 0}), cells.push_back({0, 4, i});
  const Hierarchy h = walk(smooth_cells(cells, 2));
  const auto joint = std::ranges::find(h.radii, RadiusSource::surface, &RadiusNode::source);
  ASSERT_NE(joint, h.radii.end());
  EXPECT_LT(distance(joint->centre, {0.5, 4.5, 0.5}), 0.2);
  const auto id = static_cast<std::uint32_t>(joint - h.radii.begin());
  EXPECT_NE(joint->parent, k_none);
  EXPECT_GE(std::ranges::count(h.radii, id, &RadiusNode::parent), 1);
}

}  // namespace
}  // namespace copse
