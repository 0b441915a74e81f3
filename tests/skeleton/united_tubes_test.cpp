#include "lib/analysis/skeleton/united_tubes.h"

#include "tests/skeleton/united_boxes.h"
#include "tests/trunk/welded_meshes.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

Hierarchy read(const TrunkMesh& mesh, bool has_bough = true) {
  const Surface s = surface_of(mesh);
  const Hierarchy h = read_united_tubes(s, bands_of_boxes(s, has_bough));
  if (!h.radii.empty()) {
    EXPECT_EQ(breach(h, s.positions.size(), s.triangles.size()), "");
  }
  return h;
}

const RadiusNode* find(const Hierarchy& h, const Double3& centre, double diameter) {
  const auto at = std::ranges::find_if(h.radii, [&](const RadiusNode& r) {
    return distance(r.centre, centre) < 1e-9 && std::abs(r.diameter - diameter) < 1e-9;
  });
  return at == h.radii.end() ? nullptr : &*at;
}

TEST(UnitedTubes, HaveTheRingsTheyHadBeforeTheyWereUnited) {
  const Hierarchy h = read(united_boxes());
  const double trunk = 2 * std::sqrt(2.0), bough = 0.8 * std::sqrt(2.0);
  EXPECT_EQ(h.radii.size(), 11u);
  for (const double y : {0, 1, 2, 3, 4, 5}) EXPECT_TRUE(find(h, {0, y, 0}, trunk)) << y;
  for (const double x : {0, 2, 3, 4, 5}) EXPECT_TRUE(find(h, {x, 2, 0}, bough)) << x;
}

TEST(UnitedTubes, HangTheLimbOnTheRingThatItGrowsFrom) {
  const Hierarchy h = read(united_boxes());
  const RadiusNode* base = find(h, {0, 2, 0}, 0.8 * std::sqrt(2.0));
  ASSERT_TRUE(base);
  ASSERT_NE(base->parent, k_none);
  EXPECT_LT(distance(h.radii[base->parent].centre, {0, 2, 0}), 1e-9);
  EXPECT_EQ(std::ranges::count(h.radii, k_none, &RadiusNode::parent), 1);
}

TEST(UnitedTubes, ExplainEachTriangleByTheTubeThatItLiesOn) {
  const TrunkMesh mesh = united_boxes();
  const Hierarchy h = read(mesh);
  ASSERT_EQ(h.segment_of.size(), mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    ASSERT_NE(h.segment_of[t], k_none) << t;
    const bool is_bough =
        std::ranges::any_of(mesh.triangles[t], [&](std::uint32_t v) { return mesh.positions[v].x > 1; });
    EXPECT_EQ(h.radii[h.segment_of[t]].diameter < 2, is_bough) << t;
  }
}

TEST(UnitedTubes, AreNotSeenWhereASurfaceHasNoValley) {
  EXPECT_TRUE(read(united_boxes(false), false).radii.empty());
}

TEST(UnitedTubes, AreReadFromASurfaceThatIsTurnedInsideOut) {
  TrunkMesh mesh = united_boxes();
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  EXPECT_EQ(read(mesh).radii.size(), 11u);
}

}  // namespace
}  // namespace copse
