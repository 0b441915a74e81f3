#include "lib/analysis/rings/ring_graph.h"

#include "lib/analysis/rings/fork_rings.h"
#include "tests/trunk/welded_meshes.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(RingGraph, OfATubeIsAChain) {
  const Double3 axis[] = {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}};
  const double radii[] = {1, 1, 1};
  const Surface s = surface_of(tube(axis, radii, 6, false));
  const RingGraph g = make_ring_graph(s, read_bands(s));
  EXPECT_EQ(g.nodes(), 3u);
  EXPECT_EQ(g.sites, 0u);
  std::vector<std::size_t> bands;
  for (std::uint32_t n = 0; n < 3; ++n) bands.push_back(g.bands_of[n].size());
  std::ranges::sort(bands);
  EXPECT_EQ(bands, (std::vector<std::size_t>{1, 1, 2}));
}

TEST(RingGraph, HasASiteWhereRingsShareAnEdge) {
  const WeldedMesh tree = fork_tree({.depth = 1});
  const Surface s = surface_of(tree.mesh);
  const RingGraph g = make_ring_graph(s, read_bands(s));
  ASSERT_EQ(g.sites, 1u);
  EXPECT_EQ(g.ends[0].size(), 3u);  // the ring below and the two above
  EXPECT_TRUE(g.patch[0].empty());
  EXPECT_FALSE(g.is_open[0]);
}

TEST(RingGraph, OfAFlatPieceIsOneOpenSite) {
  const TrunkMesh flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}, {0, 1}, {0, 0}};
  const Surface s = surface_of(flat);
  const RingGraph g = make_ring_graph(s, read_bands(s));
  EXPECT_EQ(g.nodes(), 0u);
  ASSERT_EQ(g.sites, 1u);
  EXPECT_EQ(g.patch[0].size(), 2u);
  EXPECT_TRUE(g.is_open[0]);
}

// Whatever the surface, bands and sites connect all rings and all loose triangles.
TEST(RingGraph, IsConnectedWhereTheSurfaceIs) {
  std::vector<Cell> cells;
  for (int y = 0; y < 9; ++y) cells.push_back({0, y, 0});
  for (int x = 1; x < 5; ++x) cells.push_back({x, 4, 0});
  const Surface s = surface_of(smooth_cells(cells, 2));
  const Bands bands = read_bands(s);
  const RingGraph g = make_ring_graph(s, bands);
  std::vector<std::uint8_t> node_seen(g.nodes(), 0), site_seen(g.sites, 0);
  std::vector<std::uint32_t> todo{0};
  node_seen[0] = 1;
  const auto visit = [&](std::uint32_t n) {
    if (!node_seen[n]) node_seen[n] = 1, todo.push_back(n);
  };
  while (!todo.empty()) {
    const std::uint32_t n = todo.back();
    todo.pop_back();
    for (const auto b : g.bands_of[n]) visit(g.across(n, b));
    const std::uint32_t site = g.site_of[n];
    if (site == k_none || site_seen[site]) continue;
    site_seen[site] = 1;
    for (const auto m : g.ends[site]) visit(m);
  }
  EXPECT_EQ(std::ranges::count(node_seen, 0), 0);
  EXPECT_EQ(std::ranges::count(site_seen, 0), 0);
}

}  // namespace
}  // namespace copse
