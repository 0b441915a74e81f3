#include "lib/analysis/leaves/piece_scan.h"

#include "lib/analysis/surface/weld.h"
#include "tests/leaves/shapes.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

PieceScan scan(const Mesh& mesh, const std::vector<std::uint32_t>& keys,
               const std::vector<PartVerdict>& verdicts) {
  const std::vector<std::uint32_t> welded = weld(mesh.positions, 0.0);
  return {mesh, welded, edge_pieces(mesh.triangles, welded, mesh.part_of, keys), verdicts};
}

TEST(PieceScan, LooksOnlyAtWhatNoFirmVerdictDecides) {
  shapes::Builder b;
  b.card({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  b.part("bark");
  b.ball({5, 0, 0}, 1);
  std::vector<PartVerdict> verdicts(2);
  verdicts[1] = {NameClass::trunk, Binding::firm, "because"};
  const PieceScan s = scan(b.mesh, {0, 1}, verdicts);
  EXPECT_FALSE(s.fact(0).decided);
  EXPECT_TRUE(s.fact(1).decided);
  EXPECT_TRUE(s.placed().empty());
  EXPECT_EQ(s.part(1), 1u);
  EXPECT_NEAR(s.bounds().max.x, 6, 0.1);
}

TEST(PieceScan, CountsWhatIsAlike) {
  shapes::Builder b;
  for (int i = 0; i < 5; ++i) b.card({i * 3.0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  b.triangle({0, 9, 0}, {1, 9, 0}, {0, 10, 0});
  const PieceScan s = scan(b.mesh, {0}, std::vector<PartVerdict>(1));
  EXPECT_EQ(s.alike(0), 5u);
  EXPECT_EQ(s.alike(5), 1u);
}

TEST(PieceScan, PlacesStemsBlobsAndWideSheets) {
  shapes::Builder b;
  b.ball({0, 5, 0}, 1);
  b.card({0, 0, 0}, {10, 0, 0}, {0, 0, 10});
  b.card({3, 0, 3}, {0.1, 0, 0}, {0, 0, 0.1});
  const PieceScan s = scan(b.mesh, {0}, std::vector<PartVerdict>(1));
  ASSERT_EQ(s.placed().size(), 2u);
  EXPECT_EQ(s.placed()[0].shape.kind, ShapeKind::blob);
  EXPECT_EQ(s.placed()[1].piece, 1u);
}

TEST(PieceScan, ABladeIsAStripWhateverTrianglesAreThereTwiceOrWithoutArea) {
  shapes::Builder b;
  std::vector<std::uint32_t> left, right;
  for (int i = 0; i < 6; ++i) left.push_back(b.point({0, 0.2 * i - 0.1, 0}));
  for (int i = 0; i < 6; ++i) right.push_back(b.point({0.1, 0.2 * i - 0.1, 0.02 * i * i}));
  for (std::size_t i = 0; i < 5; ++i) {
    b.triangle(left[i], right[i], right[i + 1]), b.triangle(left[i], right[i + 1], left[i + 1]);
  }
  for (int damage = 0; damage < 3; ++damage) {
    shapes::Builder d = b;
    if (damage == 1) d.triangle(right[0], left[0], right[1]);
    if (damage == 2)
      d.triangle(left[2], left[2], left[3]), d.triangle(right[3], d.point({0.1, 0.4, 0.13}), right[2]);
    const PieceScan s = scan(d.mesh, {0}, std::vector<PartVerdict>(1));
    EXPECT_EQ(s.pieces().count, 1u) << damage;
    EXPECT_TRUE(s.fact(0).strip) << damage;
    EXPECT_TRUE(s.fact(0).rooted) << damage;
  }
}

TEST(PieceScan, ASheetWhoseWholeBorderLiesOnOthersIsACap) {
  shapes::Builder b;
  b.triangle(b.point({0, 0, 0}), b.point({1, 0, 0}), b.point({0, 1, 0}));
  b.part("");
  const std::uint32_t tip = b.point({0, 0, 1});
  b.triangle(1, 0, tip), b.triangle(2, 1, tip), b.triangle(0, 2, tip);
  const PieceScan s = scan(b.mesh, {0, 1}, std::vector<PartVerdict>(2));
  EXPECT_TRUE(s.fact(0).capped);
}

}  // namespace
}  // namespace copse
