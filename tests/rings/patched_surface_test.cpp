#include "lib/analysis/rings/patched_surface.h"

#include "tests/trunk/welded_meshes.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

// A flat hexagon of six triangles round a vertex in its middle; the two right of the middle are the hole.
TrunkMesh hexagon() {
  TrunkMesh mesh;
  for (int i = 0; i < 6; ++i) mesh.positions.push_back({std::cos(i * 1.0472), 0, std::sin(i * 1.0472)});
  mesh.positions.push_back({});
  for (std::uint32_t i = 0; i < 6; ++i) {
    mesh.triangles.push_back({6, i, (i + 1) % 6});
    mesh.source.push_back(i), mesh.piece.push_back(0);
  }
  return mesh;
}

// The hole of triangles 0 and 1: two sides are borders, two have triangles beyond.
std::array<PatchedSurface::Side, 4> hole_of(const PatchedSurface& p) {
  return {{{6, 0, 0, p.beyond(0, 6, 0)},
           {0, 1, 0, p.beyond(0, 0, 1)},
           {1, 2, 1, p.beyond(1, 1, 2)},
           {2, 6, 1, p.beyond(1, 2, 6)}}};
}

TEST(PatchedSurface, WhatLayAcrossTheSidesOfAHoleLiesAcrossItsStandIns) {
  const Surface s = surface_of(hexagon());
  PatchedSurface patched(s);
  const auto hole = hole_of(patched);
  const Triangle stand_ins[] = {{6, 0, 2}, {0, 1, 2}};
  patched.close(hole, stand_ins);
  ASSERT_EQ(patched.size(), 8u);
  EXPECT_FALSE(patched.is_stand_in(5));
  EXPECT_TRUE(patched.is_stand_in(6));
  EXPECT_EQ(patched.beyond(6, 6, 0), 5u);
  EXPECT_EQ(patched.beyond(5, 6, 0), 6u);
  EXPECT_EQ(patched.beyond(6, 2, 6), 2u);
  EXPECT_EQ(patched.beyond(2, 2, 6), 6u);
  EXPECT_EQ(patched.beyond(6, 0, 2), 7u);
  EXPECT_EQ(patched.beyond(7, 0, 1), k_none);
  EXPECT_EQ(patched.beyond(0, 6, 0), k_none) << "what sits in the hole sees a border where it is covered";
  EXPECT_EQ(patched.beyond(0, 6, 1), 1u);
}

TEST(PatchedSurface, ReopenedIsAsItWas) {
  const Surface s = surface_of(hexagon());
  PatchedSurface patched(s);
  const auto hole = hole_of(patched);
  const Triangle stand_ins[] = {{6, 0, 2}, {0, 1, 2}};
  patched.close(hole, stand_ins);
  patched.reopen(hole);
  ASSERT_EQ(patched.size(), s.triangles.size());
  for (std::uint32_t t = 0; t < patched.size(); ++t) {
    for (std::size_t e = 0; e < 3; ++e) EXPECT_EQ(patched.across(t, e), s.across[t][e]);
  }
}

}  // namespace
}  // namespace copse
