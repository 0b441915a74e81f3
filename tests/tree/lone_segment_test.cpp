#include "lib/analysis/tree/lone_segment.h"

#include "lib/analysis/tree/trunk_arrays.h"
#include "tests/tree/tube_fixture.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

TrunkMesh one_triangle() {
  return {{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}}, {{0, 1, 2}}, {0}, {0}};
}

TEST(LoneSegment, StandsForATrunkWithoutAnyRadius) {
  const TrunkMesh trunk = one_triangle();
  Hierarchy hierarchy;
  hierarchy.segment_of = {k_none};
  ASSERT_TRUE(add_lone_segment(trunk, hierarchy));
  ASSERT_EQ(hierarchy.radii.size(), 2u);
  EXPECT_EQ(hierarchy.radii[0].centre, (Double3{4, 0, 0}));
  EXPECT_EQ(hierarchy.radii[1].centre, (Double3{0, 3, 0}));
  EXPECT_NEAR(hierarchy.radii[1].diameter, 2 * (12.0 / 5) / 3, 1e-12);
  EXPECT_EQ(hierarchy.notes.size(), 1u);
  Mesh mesh;
  mesh.positions = trunk.positions, mesh.triangles = trunk.triangles, mesh.part_of = {0},
  mesh.parts.resize(1);
  const TrunkArrays a = make_trunk_arrays(mesh, trunk, hierarchy, TreeKind::sensitive, {}, {});
  EXPECT_EQ(a.trunk.triangles.size(), 1u);
  EXPECT_EQ(a.unexplained, 1u);
}

TEST(LoneSegment, GrowsFromTheRootThatIsThere) {
  Hierarchy hierarchy;
  hierarchy.radii.push_back({{0, 0, 0}, 1});
  hierarchy.first_vertex = {0, 0};
  ASSERT_TRUE(add_lone_segment(one_triangle(), hierarchy));
  EXPECT_EQ(hierarchy.radii[1].centre, (Double3{4, 0, 0}));
  EXPECT_EQ(hierarchy.radii[0].diameter, 1);
}

TEST(LoneSegment, LeavesATrunkWithSegmentsAndAnEmptyOneAlone) {
  Tube tube = forked_tube();
  EXPECT_FALSE(add_lone_segment(tube.trunk, tube.hierarchy));
  Hierarchy none;
  EXPECT_FALSE(add_lone_segment({}, none));
  EXPECT_TRUE(none.radii.empty());
}

}  // namespace
}  // namespace copse
