#include "lib/analysis/surface/surface_copies.h"

#include "tests/trunk/welded_meshes.h"

#include <algorithm>
#include <array>
#include <utility>

#include <gtest/gtest.h>

namespace copse {
namespace {

// Adds another mesh's triangles, with vertices of their own.
void append(TrunkMesh& mesh, const TrunkMesh& more, bool flipped, const Double3& shift = {}) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const std::uint32_t piece = mesh.piece.empty() ? 0 : mesh.piece.back() + 1;
  for (const Double3& p : more.positions) mesh.positions.push_back(p + shift);
  for (Triangle t : more.triangles) {
    if (flipped) std::swap(t[1], t[2]);
    mesh.source.push_back(static_cast<std::uint32_t>(mesh.triangles.size()));
    mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    mesh.piece.push_back(piece);
  }
}

TrunkMesh tree() {
  return fork_tree({.sides = 6, .depth = 3, .seed = 2}).mesh;
}

TEST(SurfaceCopies, AreFoundWhicheverWayTheyFaceAndInWhateverOrder) {
  for (const bool flipped : {false, true}) {
    TrunkMesh mesh;
    append(mesh, tree(), false);
    append(mesh, shuffled(tree(), 5), flipped);
    const Surfaces surfaces = make_surfaces(mesh);
    ASSERT_EQ(surfaces.size(), 2u);
    const SurfaceCopies copies = find_surface_copies(mesh, surfaces);
    EXPECT_EQ(copies.original, (std::vector<std::uint32_t>{k_none, 0}));
    ASSERT_EQ(copies.triangles.size(), tree().triangles.size());
    for (const auto& [copy, original] : copies.triangles) {
      std::vector<std::array<double, 3>> a, b;
      for (const std::uint32_t v : mesh.triangles[copy])
        a.push_back({mesh.positions[v].x, mesh.positions[v].y, mesh.positions[v].z});
      for (const std::uint32_t v : mesh.triangles[original])
        b.push_back({mesh.positions[v].x, mesh.positions[v].y, mesh.positions[v].z});
      std::ranges::sort(a), std::ranges::sort(b);
      EXPECT_EQ(a, b);
    }
  }
}

TEST(SurfaceCopies, MayHaveTheirQuadsCutByTheOtherDiagonal) {
  TrunkMesh mesh, other;  // a strip of quads, cut one way and the other
  for (int i = 0; i < 5; ++i) {
    mesh.positions.push_back({0, 1.0 * i, 0.1 * i * i});
    mesh.positions.push_back({1, 1.0 * i, 0});
  }
  other.positions = mesh.positions;
  for (std::uint32_t i = 0; i < 8; i += 2) {
    mesh.triangles.push_back({i, i + 1, i + 3}), mesh.triangles.push_back({i, i + 3, i + 2});
    other.triangles.push_back({i + 2, i + 1, i}), other.triangles.push_back({i + 3, i + 1, i + 2});
  }
  TrunkMesh both;
  append(both, mesh, false);
  append(both, other, false);
  const SurfaceCopies copies = find_surface_copies(both, make_surfaces(both));
  EXPECT_EQ(copies.original, (std::vector<std::uint32_t>{k_none, 0}));
  ASSERT_EQ(copies.triangles.size(), 8u);
  for (const auto& [copy, original] : copies.triangles) EXPECT_EQ((copy - 8) / 2, original / 2);
}

TEST(SurfaceCopies, ThreeInOnePlaceAreOneAndTwoCopies) {
  TrunkMesh mesh;
  for (int i = 0; i < 3; ++i) append(mesh, tree(), i == 1);
  EXPECT_EQ(find_surface_copies(mesh, make_surfaces(mesh)).original,
            (std::vector<std::uint32_t>{k_none, 0, 0}));
}

TEST(SurfaceCopies, WhatStandsBesideOrIsCutAnotherWayIsNone) {
  TrunkMesh mesh;
  append(mesh, tree(), false);
  append(mesh, tree(), false, {1e-9, 0, 0});
  append(mesh, fork_tree({.sides = 6, .depth = 3, .twist = 0, .seed = 2}).mesh, false);
  const SurfaceCopies copies = find_surface_copies(mesh, make_surfaces(mesh));
  EXPECT_EQ(copies.original, (std::vector<std::uint32_t>(3, k_none)));
  EXPECT_TRUE(copies.triangles.empty());
}

TEST(SurfaceCopies, OfNothingAreNone) {
  const TrunkMesh mesh;
  EXPECT_TRUE(find_surface_copies(mesh, make_surfaces(mesh)).original.empty());
}

}  // namespace
}  // namespace copse
