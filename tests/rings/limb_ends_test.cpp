#include "lib/analysis/rings/limb_ends.h"

#include "tests/trunk/welded_meshes.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

namespace copse {
namespace {

// A box from the origin, its faces two triangles each.
TrunkMesh box(double x, double y, double z) {
  TrunkMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.push_back({(i & 1) != 0 ? x : 0, (i & 2) != 0 ? y : 0, (i & 4) != 0 ? z : 0});
  for (const auto& q : {std::array{0u, 1u, 5u, 4u}, std::array{2u, 6u, 7u, 3u}, std::array{0u, 2u, 3u, 1u},
                        std::array{4u, 5u, 7u, 6u}, std::array{4u, 6u, 2u, 0u}, std::array{3u, 7u, 5u, 1u}}) {
    mesh.triangles.push_back({q[0], q[1], q[2]});
    mesh.triangles.push_back({q[0], q[2], q[3]});
  }
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) mesh.source.push_back(t), mesh.piece.push_back(0);
  return mesh;
}

TEST(LimbEnds, TheEndsOfASlabAreLidsButNotRound) {
  const Surface s = surface_of(box(1, 6, 5));
  LimbEnds ends(s);
  ASSERT_EQ(ends.lids(0.9).size(), 6u);
  EXPECT_TRUE(std::ranges::all_of(ends.lids(0.9),
                                  [&](const Lid& lid) { return ends.may_close(lid, LimbEnds::Lids::any); }));
  EXPECT_EQ(std::ranges::count_if(ends.lids(0.9), [&](const Lid& lid) { return ends.is_round(lid.rim); }), 2);
  EXPECT_EQ(std::ranges::count_if(ends.lids(0.9),
                                  [&](const Lid& lid) { return ends.may_close(lid, LimbEnds::Lids::round); }),
            2);
}

TEST(LimbEnds, CornersThatTwoTrianglesOfALidShareAreLidCornersWhateverTheLidsShape) {
  const Surface s = surface_of(box(1, 6, 5));
  LimbEnds ends(s);
  for (std::uint32_t v = 0; v < 8; ++v) EXPECT_EQ(ends.is_lid_corner(v), v != 1 && v != 6) << v;
}

}  // namespace
}  // namespace copse
