#include "lib/analysis/surface/surface.h"

#include "tests/trunk/welded_meshes.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace copse {
namespace {

void expect_symmetric(const Surface& s) {
  for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
    for (std::size_t e = 0; e < 3; ++e) {
      const std::uint32_t n = s.across[t][e];
      if (n == k_none) continue;
      const std::uint32_t a = s.triangles[t][e], b = s.triangles[t][(e + 1) % 3];
      ASSERT_NE(n, t);
      ASSERT_EQ(std::ranges::count(s.triangles[n], a), 1);
      ASSERT_EQ(std::ranges::count(s.triangles[n], b), 1);
      EXPECT_EQ(s.across[n][static_cast<std::size_t>(edge_between(s.triangles[n], a, b))], t);
    }
  }
}

TEST(Surface, OfAClosedMeshHasNoBorder) {
  const Surface s = surface_of(sphere(5, 8, 1));
  EXPECT_EQ(s.border_edges, 0u);
  EXPECT_EQ(s.non_manifold_edges, 0u);
  for (const Triangle& a : s.across) EXPECT_EQ(std::ranges::count(a, k_none), 0);
  expect_symmetric(s);
}

TEST(Surface, NumbersItsVerticesAscending) {
  TrunkMesh mesh = sphere(3, 4, 1);
  const std::vector<std::uint32_t> some{5, 6, 7};
  const Surface s = make_surface(mesh, some);
  EXPECT_TRUE(std::ranges::is_sorted(s.vertex));
  for (std::size_t i = 0; i < some.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(s.vertex[s.triangles[i][c]], mesh.triangles[some[i]][c]);
  }
}

TEST(Surface, KeepsCoincidentTrianglesOnce) {
  TrunkMesh mesh{
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {2, 1, 0}, {1, 3, 2}}, {0, 1, 2}, {0, 0, 0}};
  const Surface s = surface_of(mesh);
  EXPECT_EQ(s.triangles.size(), 2u);
  EXPECT_EQ(s.triangle_of, (std::vector<std::uint32_t>{0, 0, 1}));
  EXPECT_EQ(s.non_manifold_edges, 0u);
}

// Two tetrahedra that share an edge.
TrunkMesh two_solids() {
  TrunkMesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0.5}, {1, 1, 0.5}, {-1, 0, 0.5}, {-1, -1, 0.5}};
  const auto solid = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d,
                         std::uint32_t piece) {
    for (Triangle t : {Triangle{a, b, c}, Triangle{b, a, d}, Triangle{a, c, d}, Triangle{c, b, d}}) {
      mesh.triangles.push_back(t);
      mesh.source.push_back(static_cast<std::uint32_t>(mesh.triangles.size() - 1));
      mesh.piece.push_back(piece);
    }
  };
  solid(0, 1, 3, 2, 0);
  solid(0, 1, 5, 4, 1);
  return mesh;
}

TEST(Surface, PullsSolidsThatTouchAlongAnEdgeApart) {
  for (const bool by_piece : {false, true}) {
    TrunkMesh mesh = two_solids();
    if (!by_piece) mesh.piece.assign(8, 0);
    const Surface s = surface_of(mesh);
    EXPECT_EQ(s.non_manifold_edges, 1u);
    expect_symmetric(s);
    for (std::uint32_t t = 0; t < 8; ++t) {
      for (const std::uint32_t n : s.across[t]) {
        ASSERT_NE(n, k_none);
        EXPECT_EQ(n / 4, t / 4);
      }
    }
  }
}

TEST(Surface, OfAnythingIsSymmetric) {
  for (std::uint32_t seed = 0; seed < 100; ++seed) expect_symmetric(surface_of(random_soup(12, 60, seed)));
}

TEST(BorderLoop, ReturnsTheRing) {
  const Double3 axis[] = {{0, 0, 0}, {0, 1, 0}};
  const double radii[] = {1, 1};
  const Surface s = surface_of(tube(axis, radii, 7, false));
  int borders = 0;
  for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
    for (std::size_t e = 0; e < 3; ++e) {
      if (s.across[t][e] != k_none) continue;
      ++borders;
      const auto loop = border_loop(s, t, e);
      EXPECT_EQ(loop.size(), 7u);
      for (const auto v : loop) EXPECT_EQ(s.positions[v].y, s.positions[loop[0]].y);
    }
  }
  EXPECT_EQ(borders, 14);
}

TEST(BorderLoop, EndsOnAnySurface) {
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    const Surface s = surface_of(random_soup(12, 40, seed));
    for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
      for (std::size_t e = 0; e < 3; ++e) {
        if (s.across[t][e] != k_none) continue;
        EXPECT_LE(border_loop(s, t, e).size(), 3 * s.triangles.size());
      }
    }
  }
}

TEST(Surface, ASecondLayerThatCutsQuadsByTheOtherDiagonalIsLeftOut) {
  // An open tube of four by six quads, each there once more, cut the other way.
  TrunkMesh mesh;
  for (std::uint32_t y = 0; y < 7; ++y) {
    for (std::uint32_t i = 0; i < 4; ++i)
      mesh.positions.push_back({i % 3 == 0 ? 1.0 : -1.0, 1.0 * y, i < 2 ? 1.0 : -1.0});
  }
  std::vector<std::uint32_t> all;
  for (std::uint32_t y = 0; y < 6; ++y) {
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t a = 4 * y + i, b = 4 * y + (i + 1) % 4, c = b + 4, d = a + 4;
      for (const Triangle& t : {Triangle{a, b, c}, {a, c, d}, {d, c, b}, {d, b, a}}) {
        all.push_back(static_cast<std::uint32_t>(mesh.triangles.size()));
        mesh.triangles.push_back(t);
      }
    }
  }
  const Surface s = make_surface(mesh, all);
  EXPECT_EQ(s.triangles.size(), 48u);
  EXPECT_EQ(s.non_manifold_edges, 0u);
  EXPECT_EQ(s.border_edges, 8u);
  for (std::uint32_t t = 0; t < all.size(); ++t) EXPECT_EQ(s.triangle_of[t] / 2, t / 4) << t;
}

TEST(Surface, ASolidOfFourFacesStaysOneAlsoBesideAnother) {
  TrunkMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {0, 4, 1}, {0, 1, 5}, {0, 5, 4}, {1, 4, 5}};
  const Surface s = make_surface(mesh, std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7});
  EXPECT_EQ(s.triangles.size(), 8u);
}

}  // namespace
}  // namespace copse
