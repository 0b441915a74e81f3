#include "lib/analysis/skeleton/section.h"

#include "tests/trunk/welded_meshes.h"

#include <numeric>

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(Section, OfATubeOfFewSidesIsTheRingsOwnCircle) {
  const Double3 axis[] = {{2, 0, 1}, {2, 4, 1}};
  const double radii[] = {1, 0.5};
  for (int sides = 3; sides <= 9; ++sides) {
    const Surface s = surface_of(shuffled(tube(axis, radii, sides, false), 3));
    RingCircle c;
    ASSERT_TRUE(Sections(s).cut({2.2, 1, 1.1}, {0, 1, 0}, all_triangles(tube(axis, radii, sides, false)), c));
    EXPECT_LT(distance(c.centre, {2, 1, 1}), 1e-12) << sides;
    EXPECT_NEAR(c.radius, 0.875, 1e-12) << sides;
  }
}

TEST(Section, TakesTheOutlineThatGoesRoundThePoint) {
  TrunkMesh two;
  for (const double x : {0.0, 5.0}) {
    const Double3 axis[] = {{x, 0, 0}, {x, 2, 0}};
    const double radii[] = {1, 1};
    const TrunkMesh one = tube(axis, radii, 8, false);
    const auto base = static_cast<std::uint32_t>(two.positions.size());
    two.positions.insert(two.positions.end(), one.positions.begin(), one.positions.end());
    for (Triangle t : one.triangles) two.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  }
  const Surface s = surface_of(two);
  RingCircle c;
  ASSERT_TRUE(Sections(s).cut({4.8, 1, 0.1}, {0, 1, 0}, all_triangles(two), c));
  EXPECT_NEAR(c.centre.x, 5, 1e-12);
}

TEST(Section, ThatMissesTheSurfaceIsNone) {
  const TrunkMesh mesh = sphere(5, 8, 1);
  const Surface s = surface_of(mesh);
  RingCircle c{{1, 2, 3}, 4};
  EXPECT_FALSE(Sections(s).cut({0, 7, 0}, {0, 1, 0}, all_triangles(mesh), c));
  EXPECT_FALSE(Sections(s).cut({0, 0, 0}, {0, 1, 0}, {}, c));
  EXPECT_EQ(c.radius, 4);
}

TEST(Section, OfAnOpenGutterIsFinite) {
  TrunkMesh half{{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {1, 2, 0}}, {{0, 1, 2}, {1, 3, 2}}, {0, 1}, {0, 0}};
  const Surface s = surface_of(half);
  RingCircle c;
  ASSERT_TRUE(Sections(s).cut({0.5, 1, 0}, {0, 1, 0}, all_triangles(half), c));
  EXPECT_TRUE(is_finite(c.centre));
  EXPECT_LT(c.radius, 1);
}

TEST(Section, AHeapOfTrianglesIsNotCutForEver) {
  const TrunkMesh soup = random_soup(50, 4000, 1);
  const Surface s = surface_of(soup);
  Sections sections(s);
  std::vector<std::uint32_t> seeds(s.triangles.size());
  std::iota(seeds.begin(), seeds.end(), 0u);
  int cuts = 0;
  RingCircle c;
  while (cuts < 5000 && sections.cut({0.5, 0.5, 0.5}, {0, 1, 0}, seeds, c)) ++cuts;
  EXPECT_GT(cuts, 100);
  EXPECT_LT(cuts, 5000);
}

TEST(Section, OfAnythingIsFiniteAndEnds) {
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    const TrunkMesh soup = random_soup(15, 60, seed);
    const Surface s = surface_of(soup);
    Sections sections(s);
    std::vector<std::uint32_t> seeds(s.triangles.size());
    std::iota(seeds.begin(), seeds.end(), 0u);
    for (const Double3 n : {Double3{0, 1, 0}, Double3{1, 0, 0}, normalized(Double3{1, 2, 3})}) {
      RingCircle c;
      if (!sections.cut({0.5, 0.5, 0.5}, n, seeds, c)) continue;
      EXPECT_TRUE(is_finite(c.centre) && std::isfinite(c.radius) && c.radius >= 0);
    }
  }
}

}  // namespace
}  // namespace copse
