#include "lib/analysis/surface/geodesic.h"

#include "tests/trunk/welded_meshes.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(Geodesic, AlongATubeIsItsHeight) {
  const Double3 axis[] = {{0, 0, 0}, {0, 1, 0}, {0, 2.5, 0}, {0, 4, 0}};
  const double radii[] = {1, 1, 1, 1};
  const Surface s = surface_of(tube(axis, radii, 12, false));
  std::vector<std::uint32_t> low;
  for (std::uint32_t v = 0; v < s.positions.size(); ++v) {
    if (s.positions[v].y == 0) low.push_back(v);
  }
  const auto f = geodesic_distance(s, triangles_of_vertices(s), low);
  for (std::uint32_t v = 0; v < f.size(); ++v) EXPECT_NEAR(f[v], s.positions[v].y, 1e-12);
}

TEST(Geodesic, OverASphereIsTheArc) {
  const Surface s = surface_of(sphere(60, 120, 1));
  std::uint32_t pole = 0;
  for (std::uint32_t v = 0; v < s.positions.size(); ++v) {
    if (s.positions[v].y < s.positions[pole].y) pole = v;
  }
  const std::vector<std::uint32_t> source{pole};
  const auto f = geodesic_distance(s, triangles_of_vertices(s), source);
  for (std::uint32_t v = 0; v < f.size(); ++v) {
    EXPECT_NEAR(f[v], std::acos(std::clamp(-s.positions[v].y, -1.0, 1.0)), 0.03);
  }
}

TEST(Geodesic, HasNoValleyButTheSource) {
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    const Surface s = surface_of(random_soup(20, 60, seed));
    const Lists of = triangles_of_vertices(s);
    const std::vector<std::uint32_t> source{0};
    const auto f = geodesic_distance(s, of, source);
    for (std::uint32_t v = 1; v < f.size(); ++v) {
      if (!std::isfinite(f[v])) continue;
      double least = INFINITY;
      for (const auto t : of[v]) {
        for (const auto w : s.triangles[t]) {
          if (w != v) least = std::min(least, f[w]);
        }
      }
      EXPECT_LE(least, f[v]);
    }
  }
}

TEST(Geodesic, IsInfiniteWhereTheSurfaceDoesNotLead) {
  const TrunkMesh two{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}},
                      {{0, 1, 2}, {3, 4, 5}},
                      {0, 1},
                      {0, 1}};
  const Surface s = surface_of(two);
  const std::vector<std::uint32_t> source{0};
  const auto f = geodesic_distance(s, triangles_of_vertices(s), source);
  EXPECT_TRUE(std::isinf(f[3]));
  EXPECT_DOUBLE_EQ(f[1], 1);
}

}  // namespace
}  // namespace copse
