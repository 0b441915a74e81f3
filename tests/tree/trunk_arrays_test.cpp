#include "lib/analysis/tree/trunk_arrays.h"

#include "tests/tree/tube_fixture.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

namespace copse {
namespace {

TrunkArrays arrays_of(const Tube& tube, TreeKind kind = TreeKind::sensitive, const Double3& origin = {}) {
  return make_trunk_arrays(tube.mesh, tube.trunk, tube.hierarchy, kind, origin, {});
}

Tree tree_of(TrunkArrays arrays, TreeKind kind) {
  Tree tree;
  tree.header.kind = kind;
  tree.header.ring_size = arrays.ring_size;
  tree.header.segment_factor = arrays.segment_factor;
  tree.trunk = arrays.trunk;
  tree.hierarchy = arrays.hierarchy;
  return tree;
}

// The corner positions of every stored triangle, whatever its place.
std::multiset<std::vector<float>> soup(const Tree& tree) {
  const std::vector<Float3> vertices = trunk_vertices(tree);
  std::multiset<std::vector<float>> all;
  for (const CornerTriangle& t : tree.trunk.triangles) {
    std::vector<float> corners;
    for (const std::uint32_t v : t.vertex) {
      corners.insert(corners.end(), {vertices[v].x, vertices[v].y, vertices[v].z});
    }
    all.insert(corners);
  }
  return all;
}

TEST(TrunkArrays, AreBreadthFirstWithConstantRingAndSegmentFactor) {
  const TrunkArrays a = arrays_of(forked_tube());
  EXPECT_EQ(a.roots, 1u);
  EXPECT_EQ(a.ring_size, 4u);
  EXPECT_EQ(a.segment_factor, 8u);
  EXPECT_TRUE(a.hierarchy.first_vector.empty());
  EXPECT_TRUE(a.trunk.first_triangle.empty());
  EXPECT_TRUE(a.monotone);
  ASSERT_EQ(a.hierarchy.radii.size(), 5u);
  EXPECT_EQ(a.hierarchy.radii[0].first_child, 1u);
  EXPECT_EQ(a.hierarchy.radii[1].first_child, 2u);
  EXPECT_EQ(a.hierarchy.radii[1].child_count, 2u);
  EXPECT_TRUE(a.hierarchy.radii[2].flags & Radius::terminal);
  EXPECT_EQ(a.hierarchy.radii[3].first_child, 4u);
}

TEST(TrunkArrays, SortSegmentsByAscendingDiameterAndAccumulateLengths) {
  const TrunkArrays a = arrays_of(forked_tube());
  EXPECT_EQ(a.trunk.diameters.to_vector(), (std::vector<float>{1, 3, 3, 4}));
  const double branch = distance({3, 5, 0}, {6, 6, 0}), side = distance({0, 4, 0}, {3, 5, 0});
  EXPECT_DOUBLE_EQ(a.trunk.accumulated_lengths[0], branch);
  EXPECT_DOUBLE_EQ(a.trunk.accumulated_lengths[3], branch + 4 + side + 5);
  EXPECT_EQ(a.trunk.lines[0], (std::array<std::uint32_t, 2>{3, 4}));
}

TEST(TrunkArrays, KeepEveryTriangleOfBothKinds) {
  const Tube tube = forked_tube(6);
  const Tree still = tree_of(arrays_of(tube, TreeKind::still), TreeKind::still);
  const Tree sensitive = tree_of(arrays_of(tube), TreeKind::sensitive);
  EXPECT_EQ(soup(still).size(), tube.mesh.triangles.size());
  EXPECT_EQ(soup(still), soup(sensitive));
  EXPECT_TRUE(still.hierarchy.radii.empty());
  EXPECT_TRUE(sensitive.trunk.vertices.empty());
}

TEST(TrunkArrays, GiveCapCentresToTheRingTheyClose) {
  Tube tube = forked_tube();
  const auto apex = static_cast<std::uint32_t>(tube.mesh.positions.size());
  tube.mesh.positions.push_back({0, 9, 0});
  const std::uint32_t top = tube.hierarchy.first_vertex[2];
  for (std::uint32_t i = 0; i < 4; ++i) tube.add_triangle({top + i, apex, top + (i + 1) % 4}, k_none);
  tube.trunk = {};
  tube.finish();
  const TrunkArrays a = arrays_of(tube);
  EXPECT_EQ(a.ring_size, 0u);
  EXPECT_EQ(a.hierarchy.first_vector.to_vector(), (std::vector<std::uint32_t>{0, 4, 8, 13, 17, 21}));
  EXPECT_EQ(a.unexplained, 4u);
  EXPECT_EQ(a.segment_factor, 0u);
  EXPECT_EQ(a.trunk.first_triangle[4], 36u);
  EXPECT_FLOAT_EQ(a.hierarchy.radii[2].outer_radius, 1);  // the apex is as far as the ring
}

TEST(TrunkArrays, StoreNoSegmentForAJointAndHandItsTrianglesOn) {
  Tube tube = forked_tube();
  const std::uint32_t base = tube.add_ring({-1, 3, 0}, 0.3, 4, 1, true);
  tube.add_ring({-4, 4, 0}, 0.2, 4, base);
  const std::uint32_t v = tube.hierarchy.first_vertex[base];
  tube.add_triangle({v, v + 1, v + 2}, k_none);  // a cap inside the parent
  tube.trunk = {};
  tube.finish();
  const TrunkArrays a = arrays_of(tube);
  EXPECT_EQ(a.trunk.diameters.size(), 5u);
  EXPECT_EQ(a.trunk.triangles.size(), tube.mesh.triangles.size());
  EXPECT_FLOAT_EQ(a.trunk.diameters[0], 0.6f);
  EXPECT_EQ(a.trunk.first_triangle[1], 9u);
}

TEST(TrunkArrays, StayWithinOneRoundingHoweverDeepTheChain) {
  Tube tube;
  std::uint32_t last = tube.add_ring({0.1, 0, 0}, 0.01, 3, k_none);
  for (int i = 1; i < 20000; ++i) {
    last =
        tube.add_ring({0.1 + 0.1 * std::sin(i * 0.37), i * 0.001, 0.05 * std::cos(i * 0.11)}, 0.01, 3, last);
  }
  tube.finish();
  const Tree tree = tree_of(arrays_of(tube), TreeKind::sensitive);
  const std::vector<Double3> centres = absolute_centres(tree);
  double worst = 0;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    worst = std::max(worst, distance(centres[i], tube.hierarchy.radii[i].centre));
  }
  EXPECT_LT(worst, 0.2 * 0x1p-23);  // a step is at most 0.2 long: half an ulp of it a coordinate
}

TEST(TrunkArrays, AreRelativeToTheOrigin) {
  Tube tube = forked_tube();
  const Double3 far{1e7, -3e6, 2e7};
  for (auto& p : tube.mesh.positions) p += far;
  for (auto& r : tube.hierarchy.radii) r.centre += far;
  tube.trunk = {};
  tube.finish();
  const TrunkArrays a = arrays_of(tube, TreeKind::sensitive, far), near = arrays_of(forked_tube());
  EXPECT_EQ(a.bounds.max.y, near.bounds.max.y);
  EXPECT_NEAR(a.area_density_centre.y, near.area_density_centre.y, 1e-6);
}

TEST(TrunkArrays, BoundsContainWhatAReaderRebuilds) {
  const TrunkArrays a = arrays_of(forked_tube(7));
  for (const Float3& v : trunk_vertices(tree_of(a, TreeKind::sensitive))) {
    EXPECT_TRUE(v.x >= a.bounds.min.x && v.x <= a.bounds.max.x && v.y >= a.bounds.min.y &&
                v.y <= a.bounds.max.y && v.z >= a.bounds.min.z && v.z <= a.bounds.max.z);
  }
}

TEST(TrunkArrays, NoticeAChildThickerThanItsParent) {
  Tube tube = forked_tube();
  tube.hierarchy.radii[4].diameter = 1.1;
  EXPECT_FALSE(arrays_of(tube).monotone);
}

TEST(TrunkArrays, HangLeafGroupsOnTerminalRadii) {
  const Tube tube = forked_tube();
  const TrunkArrays a = make_trunk_arrays(tube.mesh, tube.trunk, tube.hierarchy, TreeKind::sensitive, {},
                                          {k_none, k_none, k_none, k_none, 0});
  EXPECT_EQ(a.hierarchy.radii[4].first_child, 0u);
  EXPECT_EQ(a.hierarchy.radii[4].child_count, 1u);
  EXPECT_EQ(a.hierarchy.radii[2].child_count, 0u);
}

TEST(TrunkArrays, OfNothingAreEmpty) {
  Tube tube;
  tube.finish();
  const TrunkArrays a = arrays_of(tube);
  EXPECT_TRUE(a.bounds.empty());
  EXPECT_TRUE(a.trunk.triangles.empty());
  EXPECT_EQ(a.roots, 0u);
  EXPECT_FALSE(a.monotone);
}

}  // namespace
}  // namespace copse
