#include "lib/analysis/rings/fork_rings.h"

#include "tests/trunk/box_trees.h"
#include "tests/trunk/welded_meshes.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

namespace copse {
namespace {

void expect_exact(const TrunkMesh& mesh, const std::vector<TrueRing>& truth) {
  const Surface s = surface_of(mesh);
  const RingReading reading = read_fork_rings(s);
  EXPECT_EQ(breach(reading.hierarchy, s.positions.size(), s.triangles.size()), "");
  const Match m = match(reading.hierarchy, truth, 1e-9);
  EXPECT_EQ(m.found, truth.size());
  EXPECT_EQ(m.extra, 0u);
  EXPECT_EQ(m.wrong_parents, 0u);
  EXPECT_LT(m.worst_diameter, 1e-12);
}

TEST(ForkRings, OfForksThatShareVerticesAreExactForEveryNumberOfSides) {
  for (const std::uint32_t sides : {4u, 6u, 8u, 12u, 20u}) {
    SCOPED_TRACE(sides);
    const WeldedMesh tree = fork_tree({.sides = sides, .seed = sides});
    expect_exact(tree.mesh, tree.rings);
  }
}

TEST(ForkRings, DoNotDependOnTheOrderOfTheFileNorOnHowTrianglesAreTurned) {
  const WeldedMesh tree = fork_tree({.depth = 6, .seed = 3});
  for (std::uint32_t seed = 0; seed < 5; ++seed) expect_exact(shuffled(tree.mesh, seed), tree.rings);
}

TEST(ForkRings, SurviveTwistsOfHalfASide) {
  for (int twist = 0; twist <= 2; ++twist) {
    const WeldedMesh tree = fork_tree({.sides = 8, .twist = twist, .seed = 5});
    expect_exact(tree.mesh, tree.rings);
  }
}

TEST(ForkRings, AreFoundUnderBluntTips) {
  for (const double length : {1.0, 1.2, 1.5}) {
    SCOPED_TRACE(length);
    const WeldedMesh tree = fork_tree({.depth = 4, .tip_length = length, .seed = 9});
    std::vector<TrueRing> rings;  // without the tips: some of these close a limb rather than end in a point
    for (const TrueRing& r : tree.rings) {
      if (r.diameter > 0) rings.push_back(r);
    }
    std::vector<std::uint32_t> number(tree.rings.size(), k_none);
    for (std::uint32_t i = 0, n = 0; i < tree.rings.size(); ++i) {
      if (tree.rings[i].diameter > 0) number[i] = n++;
    }
    for (TrueRing& r : rings) r.parent = r.parent == k_none ? k_none : number[r.parent];
    const Surface s = surface_of(tree.mesh);
    const Match m = match(read_fork_rings(s).hierarchy, rings, 1e-9);
    EXPECT_EQ(m.found, rings.size());
    EXPECT_EQ(m.extra, 0u);
    EXPECT_EQ(m.wrong_parents, 0u);
  }
}

TEST(ForkRings, OfLimbsThatGrowOutOfAQuadAreExact) {
  const std::vector<int> sparse{2, 6}, dense{1, 2, 3, 4, 5, 6, 7};
  for (const std::vector<int>& seats : {sparse, dense}) {
    const WeldedMesh tree = seated_limbs(10, seats, 4);
    expect_exact(tree.mesh, tree.rings);
    expect_exact(shuffled(tree.mesh, 1), tree.rings);
  }
}

void expect_exact(const BoxTree& shape) {
  const BoxTreeMesh tree = box_tree(shape);
  for (const TrunkMesh& mesh : {tree.mesh, shuffled(tree.mesh, shape.seed)}) {
    const Surface s = surface_of(mesh);
    const RingReading reading = read_fork_rings(s);
    EXPECT_EQ(breach(reading.hierarchy, s.positions.size(), s.triangles.size()), "");
    const Exactness e = measure(tree.truth, reading.hierarchy);
    EXPECT_TRUE(e.exact()) << "seed " << shape.seed << ": " << e.found << " of " << e.rings << " rings, "
                           << e.parents_right << " parents, " << e.extra << " extra: " << e.first_fault;
    EXPECT_EQ(std::ranges::count(reading.hierarchy.segment_of, k_none), 0) << shape.seed;
  }
}

TEST(ForkRings, OfFacesThatWerePulledOutOfAClosedTubeAreExact) {
  for (const std::uint32_t sides : {5u, 6u, 8u, 12u, 24u}) {
    for (const bool inset : {false, true}) {
      expect_exact({.sides = sides, .depth = 1, .share = 1.0 / sides, .inset = inset, .seed = sides});
    }
  }
}

TEST(ForkRings, OfFacesThatWerePulledOutOfWhatWasPulledOutAreExactWithEveryEnd) {
  for (const bool open : {false, true}) {
    for (const bool inset : {false, true}) {
      for (std::uint32_t seed = 1; seed < 5; ++seed)
        expect_exact({.depth = 2, .share = 0.05, .open = open, .inset = inset, .seed = seed});
    }
  }
}

// What Blender's skin and subdivision modifiers make: quads throughout, closed, forks of irregular vertices.
TEST(ForkRings, OfSubdividedLimbsAreTheEdgeLoops) {
  std::vector<Cell> cells;
  for (int y = 0; y < 14; ++y) cells.push_back({0, y, 0});
  for (int x = 1; x < 8; ++x) cells.push_back({x, 6, 0});
  for (int z = 1; z < 7; ++z) cells.push_back({0, 10, z});
  for (int rounds = 1; rounds <= 2; ++rounds) {
    SCOPED_TRACE(rounds);
    const TrunkMesh mesh = smooth_cells(cells, rounds);
    const Surface s = surface_of(mesh);
    const RingReading reading = read_fork_rings(s);
    const Hierarchy& h = reading.hierarchy;
    EXPECT_EQ(breach(h, s.positions.size(), s.triangles.size()), "");
    EXPECT_GT(reading.in_bands, 0.8);
    EXPECT_LT(h.radii[0].centre.y, 0.6);
    std::set<int> trunk, first, second;  // levels at which there is a ring, in steps of the subdivision
    const double step = 1 << rounds;
    for (std::size_t r = 0; r < h.radii.size(); ++r) {
      const Double3 c = h.radii[r].centre;
      if (h.radii[r].source != RadiusSource::ring) continue;
      if (c.x > 2.2) first.insert(static_cast<int>(std::lround(c.x * step)));
      if (c.z > 2.2) second.insert(static_cast<int>(std::lround(c.z * step)));
      if (c.x < 1.2 && c.z < 1.2 && (c.y < 5 || (c.y > 8 && c.y < 9) || c.y > 12)) {
        EXPECT_NEAR(c.x, 0.5, 0.01);
        EXPECT_NEAR(c.z, 0.5, 0.01);
        trunk.insert(static_cast<int>(std::lround(c.y * step)));
      }
    }
    for (int y = 1; y <= 4; ++y) EXPECT_TRUE(trunk.contains(y << rounds)) << y;
    for (int x = 3; x <= 6; ++x) EXPECT_TRUE(first.contains(x << rounds)) << x;
    for (int z = 3; z <= 5; ++z) EXPECT_TRUE(second.contains(z << rounds)) << z;
    // From each tip the way down leads through the limb's own fork to the root.
    for (const bool is_second : {false, true}) {
      std::uint32_t tip = 0;
      const auto out = [&](std::uint32_t r) { return is_second ? h.radii[r].centre.z : h.radii[r].centre.x; };
      for (std::uint32_t r = 0; r < h.radii.size(); ++r) {
        if (out(r) > out(tip)) tip = r;
      }
      while (out(tip) > 0.9 && h.radii[tip].parent != k_none) tip = h.radii[tip].parent;
      EXPECT_NEAR(h.radii[tip].centre.y, is_second ? 10.5 : 6.5, 1.6);
    }
  }
}

TEST(ForkRings, OfATorusAreCutOnce) {
  const TrunkMesh mesh = torus(24, 6, 5, 1);
  const Surface s = surface_of(mesh);
  const RingReading reading = read_fork_rings(s);
  EXPECT_EQ(reading.hierarchy.radii.size(), 24u);
  EXPECT_EQ(breach(reading.hierarchy, s.positions.size(), s.triangles.size()), "");
  EXPECT_EQ(std::ranges::count(reading.hierarchy.segment_of, k_none), 12);
}

TEST(ForkRings, OfNothingAreNone) {
  EXPECT_TRUE(read_fork_rings(Surface{}).hierarchy.radii.empty());
  const TrunkMesh flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {0}, {0}};
  EXPECT_TRUE(read_fork_rings(surface_of(flat)).hierarchy.radii.empty());
}

TEST(ForkRings, OfAnythingAreSound) {
  for (std::uint32_t seed = 0; seed < 300; ++seed) {
    const TrunkMesh soup = random_soup(6 + seed % 40, 1 + seed, seed);
    const Surface s = surface_of(soup);
    const Hierarchy h = read_fork_rings(s).hierarchy;
    if (h.radii.empty()) continue;
    EXPECT_EQ(breach(h, s.positions.size(), s.triangles.size()), "") << seed;
  }
}

}  // namespace
}  // namespace copse
