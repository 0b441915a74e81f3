#include "lib/analysis/trunk/strict_hierarchy.h"

#include "tests/trunk/strict_models.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

StrictTrunk read(const StrictModelMesh& m) {
  return strict_hierarchy(m.read(), m.mesh, m.welded(), m.leaf_of);
}

TEST(StrictHierarchy, HasTheModelsRadiiWithTheThickestChildFirst) {
  const StrictTrunk s = read(sound_model(6));
  const auto& radii = s.hierarchy.radii;
  ASSERT_EQ(radii.size(), 4u);
  const std::vector<Double3> centres{{0, -1, 0}, {0, 2, 0}, {0, 5, 0}, {3, 3, 0}};
  const std::vector<double> radius{1, 0.9, 0.5, 0.4};
  const std::vector<std::uint32_t> parent{k_none, 0, 1, 1}, branch{0, 0, 0, 1};
  for (std::size_t r = 0; r < 4; ++r) {
    EXPECT_LT(distance(radii[r].centre, centres[r]), 1e-12) << r;
    EXPECT_NEAR(radii[r].diameter, 2 * radius[r], 1e-12) << r;
    EXPECT_EQ(radii[r].parent, parent[r]) << r;
    EXPECT_EQ(radii[r].branch, branch[r]) << r;
    EXPECT_FALSE(radii[r].joint) << r;
  }
}

TEST(StrictHierarchy, RingsGoRoundWhateverTheOrderOfTheVertices) {
  StrictModelMesh m = sound_model(8);
  std::swap(m.mesh.positions[9], m.mesh.positions[13]);
  for (Triangle& t : m.mesh.triangles) {
    for (std::uint32_t& v : t) v = v == 9 ? 13 : v == 13 ? 9 : v;
  }
  const StrictTrunk s = read(m);
  for (std::uint32_t r = 0; r < 4; ++r) {
    for (std::uint32_t i = 0; i < 8; ++i) {
      const std::uint32_t first = s.hierarchy.first_vertex[r];
      const Double3 &a = s.mesh.positions[s.hierarchy.ring_vertices[first + i]],
                    &b = s.mesh.positions[s.hierarchy.ring_vertices[first + (i + 1) % 8]];
      EXPECT_NEAR(distance(a, b), s.hierarchy.radii[r].diameter * std::sin(std::numbers::pi / 8), 1e-9) << r;
    }
  }
}

TEST(StrictHierarchy, EveryTriangleHasTheSegmentOfItsBandAndLidsThatWhichEndsThere) {
  StrictModelMesh m = sound_model(5);
  m.triangle(10, 11, 12), m.triangle(10, 12, 13), m.triangle(10, 13, 14);  // the top
  m.triangle(0, 1, 2), m.triangle(0, 2, 3), m.triangle(0, 3, 4);           // the bottom
  const StrictTrunk s = read(m);
  std::vector<std::uint32_t> expected(10, 1);
  expected.insert(expected.end(), 10, 2);
  expected.insert(expected.end(), 10, 3);
  expected.insert(expected.end(), 3, 2);
  expected.insert(expected.end(), 3, 1);
  EXPECT_EQ(s.hierarchy.segment_of, expected);
}

TEST(StrictHierarchy, TheRootIsBelowTheGroundHoweverThinItIs) {
  StrictModelMesh m;
  const auto root = m.ring({0, -0.3, 0}, 0.1, 5), middle = m.ring({0, 2, 0}, 0.5, 5),
             top = m.ring({0, 4, 0}, 1, 5);
  m.band(top, middle, 5), m.band(middle, root, 5);
  const StrictTrunk s = read(m);
  EXPECT_DOUBLE_EQ(s.hierarchy.radii[0].centre.y, -0.3);
  EXPECT_EQ(s.hierarchy.radii[2].centre.y, 4);
}

TEST(StrictHierarchy, FollowsAVineOfAHundredThousandSegments) {
  const StrictTrunk s = read(vine_model(100'000));
  EXPECT_EQ(s.hierarchy.radii.size(), 100001u);
  EXPECT_EQ(s.hierarchy.radii.back().branch, 0u);
}

TEST(StrictHierarchy, OfNothingIsNothing) {
  EXPECT_TRUE(read(StrictModelMesh()).hierarchy.radii.empty());
}

}  // namespace
}  // namespace copse
