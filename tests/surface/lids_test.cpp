#include "lib/analysis/surface/lids.h"

#include "lib/analysis/surface/surface.h"
#include "tests/trunk/welded_meshes.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace copse {
namespace {

std::vector<SharedEdge> edges_of(const Surface& s) {
  std::vector<SharedEdge> edges;
  for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
    for (std::size_t e = 0; e < 3; ++e) {
      const std::uint32_t n = s.across[t][e];
      if (n != k_none && n > t) edges.push_back({s.triangles[t][e], s.triangles[t][(e + 1) % 3], t, n});
    }
  }
  return edges;
}

std::vector<Lid> lids_of(const TrunkMesh& mesh, double smooth = 0.9) {
  const Surface s = surface_of(mesh);
  return find_lids(s.positions, s.triangles, edges_of(s), smooth);
}

// A straight prism of 8 sides; its ends closed by fans with a vertex in the middle, or by fans from a corner.
TrunkMesh prism(bool middles) {
  const Double3 axis[] = {{0, 0, 0}, {0, 2, 0}, {0, 5, 0}};
  const double radii[] = {1, 1, 1};
  TrunkMesh mesh = tube(axis, radii, 8, false);
  for (const std::uint32_t first : {0u, 16u}) {
    if (middles) {
      const auto centre = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.push_back(axis[first == 0 ? 0 : 2]);
      for (std::uint32_t i = 0; i < 8; ++i)
        mesh.triangles.push_back({centre, first + i, first + (i + 1) % 8});
    } else {
      for (std::uint32_t i = 1; i < 7; ++i) mesh.triangles.push_back({first, first + i, first + i + 1});
    }
  }
  mesh.piece.assign(mesh.triangles.size(), 0), mesh.source.clear();  // of the ends too
  return mesh;
}

TEST(Lids, AreFoundWithAndWithoutAVertexInTheMiddle) {
  for (const bool middles : {false, true}) {
    std::vector<Lid> lids = lids_of(prism(middles));
    std::erase_if(lids, [](const Lid& lid) { return lid.rim.size() != 8; });  // the sides are flat, too
    ASSERT_EQ(lids.size(), 2u);
    for (const Lid& lid : lids) {
      EXPECT_EQ(lid.triangles.size(), middles ? 8u : 6u);
      EXPECT_EQ(lid.middle != k_none, middles);
      EXPECT_EQ(std::ranges::count(lid.rim, lid.middle), 0);
    }
  }
}

TEST(Lids, OfABoxAreItsSixSides) {
  const Cell cell[] = {{0, 0, 0}};
  const std::vector<Lid> lids = lids_of(smooth_cells(cell, 0));
  ASSERT_EQ(lids.size(), 6u);
  for (const Lid& lid : lids) EXPECT_EQ(lid.rim.size(), 4u);
}

TEST(Lids, DoNotDependOnHowTrianglesAreTurned) {
  EXPECT_EQ(lids_of(prism(true)).size(), lids_of(shuffled(prism(true), 3)).size());
}

TEST(Lids, OfASmoothSurfaceAreNone) {
  EXPECT_TRUE(lids_of(sphere(24, 24, 1), 0.5).empty());
  EXPECT_TRUE(lids_of(torus(24, 24, 3, 1), 0.5).empty());
}

TEST(Lids, OfAnythingAreDiscs) {
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    const TrunkMesh soup = random_soup(8 + seed % 30, 4 + seed, seed);
    for (const Lid& lid : lids_of(soup)) {
      EXPECT_EQ(lid.triangles.size() + (lid.middle == k_none ? 2 : 0), lid.rim.size());
    }
  }
}

TEST(Lids, TheSideOfALimbIsNoPartOfTheLidThatItIsFlushWith) {
  TrunkMesh mesh;  // a square, sides that go down from three of its edges, and one in its plane at the fourth
  mesh.positions = {{0, 0, 0}, {1, 0, 0},    {1, 0, 1},    {0, 0, 1},   {2, 0, 0},
                    {2, 0, 1}, {0.5, -1, 0}, {0.5, -1, 1}, {0, -1, 0.5}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}, {1, 0, 6}, {3, 2, 7}, {0, 3, 8}};
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) mesh.source.push_back(t), mesh.piece.push_back(0);
  const Surface s = surface_of(mesh);
  const auto has_square = [&](std::span<const std::uint8_t> settled) {
    return std::ranges::any_of(find_lids(s.positions, s.triangles, edges_of(s), 0.9, settled),
                               [](const Lid& l) {
                                 return l.triangles == std::vector<std::uint32_t>{0, 1} && l.rim.size() == 4;
                               });
  };
  EXPECT_FALSE(has_square({}));
  EXPECT_TRUE(has_square(std::vector<std::uint8_t>{0, 0, 1, 1, 0, 0, 0}));
}

}  // namespace
}  // namespace copse
