#include "lib/analysis/surface/quads.h"

#include "tests/trunk/welded_meshes.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

// A slanted tube: the true quads are parallelograms, so only the order tells them from their neighbours.
TrunkMesh slanted_tube() {
  TrunkMesh mesh;
  for (int r = 0; r < 6; ++r) {
    for (int i = 0; i < 6; ++i) {
      const double a = 1.0472 * (i + 0.7 * r);
      mesh.positions.push_back({std::cos(a), 0.8 * r, -std::sin(a)});
    }
  }
  for (std::uint32_t r = 0; r < 5; ++r) {
    for (std::uint32_t i = 0; i < 6; ++i) {
      const std::uint32_t a = 6 * r + i, b = 6 * r + (i + 1) % 6;
      mesh.triangles.push_back({a, b, b + 6});
      mesh.triangles.push_back({a, b + 6, a + 6});
    }
  }
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) mesh.source.push_back(t), mesh.piece.push_back(0);
  return mesh;
}

// Squares that have been sheared to slivers: by its shape none is a quad.
TEST(Quads, AreReadFromTheOrderOfTheFileHoweverSlantedWhereNothingElseCounts) {
  TrunkMesh strip;
  for (std::uint32_t i = 0; i <= 6; ++i) {
    strip.positions.push_back({static_cast<double>(i), 0, 0});
    strip.positions.push_back({static_cast<double>(i) + 60, 1, 0});
  }
  for (std::uint32_t i = 0; i < 6; ++i) {
    strip.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
    strip.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
  }
  const Surface s = surface_of(strip);
  const std::vector<std::uint32_t> taken(s.triangles.size(), k_none);
  const auto partner = pair_all_quads(s);
  ASSERT_EQ(partner.size(), s.triangles.size());
  for (std::uint32_t t = 0; t < partner.size(); ++t) EXPECT_EQ(partner[t], t ^ 1u);
  EXPECT_NE(pair_quads(s, taken, QuadOrder::file), partner);
}

TEST(Quads, AreNoneWhereOneTriangleIsLeftOver) {
  std::vector<Cell> cells{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}};
  TrunkMesh mesh = smooth_cells(cells, 0);
  const auto all = pair_all_quads(surface_of(mesh));
  ASSERT_EQ(all.size(), mesh.triangles.size());
  for (std::uint32_t t = 0; t < all.size(); ++t) EXPECT_EQ(all[all[t]], t);
  mesh.triangles.pop_back(), mesh.source.pop_back(), mesh.piece.pop_back();
  EXPECT_TRUE(pair_all_quads(surface_of(mesh)).empty());
  // Even in number, but one is far from square with each of its neighbours.
  mesh.positions.push_back(mesh.positions[mesh.triangles[0][0]] + Double3{40, 40, 40});
  mesh.triangles.push_back(
      {mesh.triangles[0][0], mesh.triangles[0][1], static_cast<std::uint32_t>(mesh.positions.size() - 1)});
  mesh.source.push_back(2 * mesh.source.back() + 1000), mesh.piece.push_back(0);
  EXPECT_TRUE(pair_all_quads(surface_of(mesh)).empty());
}

TEST(Quads, AreReadFromTheOrderOfTheFile) {
  const Surface s = surface_of(slanted_tube());
  const std::vector<std::uint32_t> taken(s.triangles.size(), k_none);
  const auto partner = pair_quads(s, taken, QuadOrder::file);
  for (std::uint32_t t = 0; t < partner.size(); ++t) EXPECT_EQ(partner[t], t ^ 1u);
}

TEST(Quads, AreReadFromTheirShapeInAnyOrder) {
  std::vector<Cell> cells{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}};
  const Surface s = surface_of(shuffled(smooth_cells(cells, 0), 4));
  const std::vector<std::uint32_t> taken(s.triangles.size(), k_none);
  const auto partner = pair_quads(s, taken, QuadOrder::shape);
  for (std::uint32_t t = 0; t < partner.size(); ++t) {
    ASSERT_NE(partner[t], k_none);
    EXPECT_EQ(partner[partner[t]], t);
  }
}

TEST(Quads, LeaveTakenTrianglesAlone) {
  const Surface s = surface_of(slanted_tube());
  std::vector<std::uint32_t> taken(s.triangles.size(), k_none);
  taken[4] = taken[5] = 0;
  for (const QuadOrder order : {QuadOrder::shape, QuadOrder::file}) {
    const auto partner = pair_quads(s, taken, order);
    EXPECT_EQ(partner[4], k_none);
    EXPECT_EQ(partner[5], k_none);
  }
}

TEST(QuadBands, GoRoundALimbAndNotAlongIt) {
  std::vector<Cell> cells;
  for (int y = 0; y < 8; ++y) cells.push_back({0, y, 0});
  const Surface s = surface_of(smooth_cells(cells, 1));
  Bands bands;
  bands.band_of.assign(s.triangles.size(), k_none);
  add_quad_bands(s, pair_quads(s, bands.band_of, QuadOrder::file), bands);
  EXPECT_GE(bands.count(), 14u);
  for (std::uint32_t r = 0; r < 2 * bands.count(); ++r) {
    EXPECT_EQ(bands.ring(r).size(), 8u);
    const RingCircle c = ring_circle(s.positions, bands.ring(r));
    EXPECT_NEAR(c.centre.x, 0.5, 1e-9);
    EXPECT_NEAR(c.centre.z, 0.5, 1e-9);
  }
}

TEST(QuadBands, OfAMoebiusStripAreNone) {
  const Surface s = surface_of(moebius(20));
  Bands bands;
  bands.band_of.assign(s.triangles.size(), k_none);
  add_quad_bands(s, pair_quads(s, bands.band_of, QuadOrder::file), bands);
  EXPECT_EQ(bands.count(), 0u);
}

}  // namespace
}  // namespace copse
