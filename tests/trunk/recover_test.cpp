// The whole trunk, and everything that a file may throw at it.
#include "lib/analysis/trunk/recover.h"

#include "tests/trunk/tube_maker.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <set>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace copse {
namespace {

Hierarchy recover(const Mesh& mesh, Skeleton skeleton = Skeleton::automatic) {
  return recover_hierarchy(make_trunk_mesh(mesh, all_trunk(mesh)), {skeleton});
}

// What holds of every hierarchy, whatever the mesh.
::testing::AssertionResult is_sound(const Hierarchy& h, const TrunkMesh& trunk) {
  const auto bad = [](const std::string& what) { return ::testing::AssertionFailure() << what; };
  if (h.first_vertex.size() != h.radii.size() + 1) return bad("offsets");
  if (h.segment_of.size() != trunk.triangles.size()) return bad("segment_of");
  std::set<std::uint32_t> seen;
  for (std::uint32_t r = 0; r < h.radii.size(); ++r) {
    const RadiusNode& node = h.radii[r];
    if (node.parent != k_none && node.parent >= r) return bad("a parent after its child");
    if (!is_finite(node.centre) || !std::isfinite(node.diameter) || node.diameter < 0) return bad("a number");
    if (node.parent == k_none && node.joint) return bad("a root that is a joint");
    for (std::uint32_t i = h.first_vertex[r]; i < h.first_vertex[r + 1]; ++i) {
      if (h.ring_vertices[i] >= trunk.positions.size()) return bad("a vertex out of range");
      if (!seen.insert(h.ring_vertices[i]).second) return bad("a vertex of two radii");
    }
  }
  for (const std::uint32_t s : h.segment_of) {
    if (s == k_none) continue;
    if (s >= h.radii.size() || h.radii[s].parent == k_none || h.radii[s].joint) return bad("a segment");
  }
  if (!trunk.triangles.empty() && h.radii.empty()) return bad("no radius");
  return ::testing::AssertionSuccess();
}

::testing::AssertionResult is_sound(const Mesh& mesh) {
  const TrunkMesh trunk = make_trunk_mesh(mesh, all_trunk(mesh));
  for (const Skeleton skeleton : {Skeleton::automatic, Skeleton::rings, Skeleton::surface}) {
    const auto result = is_sound(recover_hierarchy(trunk, {skeleton}), trunk);
    if (!result) return result;
  }
  return ::testing::AssertionSuccess();
}

Mesh mesh_of(std::vector<Double3> positions, std::vector<Triangle> triangles) {
  Mesh mesh;
  mesh.positions = std::move(positions);
  mesh.triangles = std::move(triangles);
  mesh.part_of.assign(mesh.triangles.size(), 0);
  mesh.parts.resize(1);
  return mesh;
}

TubeShape tube(const Double3& from, const Double3& to, int rings, double thick, double thin, int sides = 6) {
  TubeShape shape;
  shape.axis = axis_between(from, to, rings);
  shape.radius = taper_between(thick, thin, rings);
  shape.sides = sides;
  return shape;
}

// A trunk with four branches with two twigs each, all pushed into their parents.
Mesh little_tree(double scale, const Double3& offset) {
  TubeMaker maker;
  const auto add = [&](const Double3& from, const Double3& to, double thick, double thin, int sides) {
    TubeShape shape = tube(from * scale + offset, to * scale + offset, 6, thick * scale, thin * scale, sides);
    maker.add(shape);
  };
  add({0, -0.1, 0}, {0, 8, 0}, 0.4, 0.1, 8);
  for (int i = 0; i < 4; ++i) {
    const double y = 2 + i, x = i % 2 == 0 ? 3 : -3, z = i - 1.5;
    add({0, y, 0}, {x, y + 1.5, z}, 0.2, 0.05, 6);
    for (const double t : {0.45, 0.8}) {
      add({x * t, y + 1.5 * t, z * t}, {x * t, y + 1.5 * t + 1.2, z * t + 0.8}, 0.06, 0.01, 5);
    }
  }
  return maker.mesh;
}

TEST(Recover, FindsALittleTreeAtEverySizeAndFarFromTheOrigin) {
  struct Case {
    double scale;
    Double3 offset;
  };
  for (const Case& c : {Case{1, {}}, Case{1, {1e7, 0, 2e7}}, Case{1e-30, {}}, Case{1e30, {}}}) {
    const Hierarchy h = recover(little_tree(c.scale, c.offset));
    EXPECT_EQ(h.radii.size(), 78u);
    EXPECT_EQ(std::ranges::count(h.radii, k_none, &RadiusNode::parent), 1);
    EXPECT_EQ(std::ranges::count(h.radii, true, &RadiusNode::joint), 12);
    EXPECT_NEAR((h.radii[0].centre.y - c.offset.y) / c.scale, -0.1, 1e-9);
    EXPECT_NEAR(h.radii[0].diameter / c.scale, 0.8, 1e-8);
    for (const std::uint32_t s : h.segment_of) EXPECT_NE(s, k_none);
  }
}

TEST(Recover, OfNothingIsNothing) {
  EXPECT_TRUE(recover(Mesh{}).radii.empty());
  EXPECT_TRUE(is_sound(Mesh{}));
}

TEST(Recover, ASingleTriangleIsASegment) {
  const Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 4, 0}}, {{0, 1, 2}});
  EXPECT_TRUE(is_sound(mesh));
  const Hierarchy h = recover(mesh);
  EXPECT_EQ(h.radii.size(), 2u);
  EXPECT_EQ(h.segment_of, (std::vector<std::uint32_t>{1}));
}

TEST(Recover, ASingleRingIsSound) {
  for (int k = 3; k < 9; ++k) {
    std::vector<Double3> p;
    std::vector<Triangle> t;
    for (int j = 0; j < k; ++j) p.push_back({std::cos(6.283 * j / k), 0, std::sin(6.283 * j / k)});
    for (std::uint32_t j = 1; j + 1 < static_cast<std::uint32_t>(k); ++j) t.push_back({0, j, j + 1});
    EXPECT_TRUE(is_sound(mesh_of(p, t)));
  }
}

TEST(Recover, AllPointsEqualLeaveNothing) {
  const Mesh mesh = mesh_of(std::vector<Double3>(6, {3, 3, 3}), {{0, 1, 2}, {3, 4, 5}});
  EXPECT_TRUE(recover(mesh).radii.empty());
}

TEST(Recover, CollinearTrianglesAreSound) {
  EXPECT_TRUE(is_sound(mesh_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, {{0, 1, 2}, {1, 2, 3}})));
}

TEST(Recover, TwoRingsUnderTheGroundAreOneRootAndItsChild) {
  TubeMaker maker;
  TubeShape shape = tube({0, -0.5, 0}, {0, 9.5, 0}, 21, 0.4, 0.1);
  maker.add(shape);
  const Hierarchy h = recover(maker.mesh);
  ASSERT_EQ(h.radii.size(), 21u);
  EXPECT_EQ(std::ranges::count(h.radii, k_none, &RadiusNode::parent), 1);
  EXPECT_NEAR(h.radii[0].centre.y, -0.5, 1e-12);
}

TEST(Recover, AVineOfAHundredThousandSegmentsIsOneBranch) {
  TubeMaker maker;
  TubeShape vine = tube({0, 0, 0}, {0, 3000, 0}, 100001, 0.02, 0.005, 3);
  maker.add(vine);
  const Hierarchy h = recover(maker.mesh);
  ASSERT_EQ(h.radii.size(), 100001u);
  EXPECT_EQ(h.radii.back().parent, 99999u);
  EXPECT_EQ(h.radii.back().branch, 0u);
}

TEST(Recover, AChainOfTenThousandTubesGrowsOutOfOneRoot) {
  TubeMaker maker;
  for (int i = 0; i < 10000; ++i) {
    maker.add(tube({0, 1.0 * i, 0}, {0, 1.0 * i + 1.2, 0}, 3, 0.2, 0.1, 4));
  }
  const Hierarchy h = recover(maker.mesh);
  EXPECT_EQ(std::ranges::count(h.radii, k_none, &RadiusNode::parent), 1);
}

// A box 4 m wide, 3 m deep and 0.1 m thick.
void add_plate(Mesh& mesh) {
  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::uint32_t i = 0; i < 8; ++i)
    mesh.positions.push_back({i & 1 ? 2.0 : -2.0, i & 2 ? 0.0 : -0.1, i & 4 ? 1.5 : -1.5});
  for (const auto& [a, b, c, d] : std::initializer_list<std::array<std::uint32_t, 4>>{
           {0, 1, 3, 2}, {5, 4, 6, 7}, {4, 0, 2, 6}, {1, 5, 7, 3}, {2, 3, 7, 6}, {4, 5, 1, 0}}) {
    mesh.triangles.push_back({base + a, base + b, base + c});
    mesh.triangles.push_back({base + a, base + c, base + d});
    mesh.part_of.insert(mesh.part_of.end(), 2, 0);
  }
}

TEST(Recover, GroundThatTreesStandOnIsAStubAndNoLyingLimb) {
  TubeMaker maker;
  maker.add(tube({0, 0, 0}, {0, 3, 0}, 4, 0.2, 0.1, 6));
  maker.add(tube({1, 0, 1}, {1, 2, 1}, 3, 0.2, 0.1, 6));
  add_plate(maker.mesh);
  const Hierarchy h = recover(maker.mesh);
  EXPECT_TRUE(is_sound(maker.mesh));
  ASSERT_EQ(h.radii.size(), 4u + 3u + 2u);
  EXPECT_EQ(std::ranges::count(h.radii, k_none, &RadiusNode::parent), 3);
  const auto top = std::ranges::find(h.radii, RadiusSource::surface, &RadiusNode::source) + 1;
  ASSERT_NE(top->parent, k_none);
  const RadiusNode& foot = h.radii[top->parent];
  EXPECT_EQ(std::abs(top->centre.y - foot.centre.y), 0.1);
  EXPECT_EQ(Double3(top->centre.x, 0, top->centre.z), Double3(foot.centre.x, 0, foot.centre.z));
  EXPECT_DOUBLE_EQ(top->diameter, 5);
  EXPECT_EQ(std::ranges::count(h.segment_of, static_cast<std::uint32_t>(top - h.radii.begin())), 12);
}

TEST(Recover, SharesTheRadiusWhereTubesAreLaidEndToEnd) {
  TubeMaker maker;
  maker.add(tube({0, 0, 0}, {0, 4, 0}, 5, 0.4, 0.3, 12));
  maker.add(tube({0, 4, 0}, {0, 7, 0}, 4, 0.3, 0.2, 6));
  TubeShape turned = tube({0, 7, 0}, {0, 9, 0}, 3, 0.2, 0.1, 6);
  turned.turn = 0.5;
  maker.add(turned);
  const Hierarchy h = recover(maker.mesh);
  EXPECT_EQ(h.radii.size(), 10u);
  EXPECT_EQ(std::ranges::count(h.radii, true, &RadiusNode::joint), 0);
  EXPECT_EQ(h.first_vertex.back(), 5 * 12 + 4 * 6 + 3 * 6u);
}

// What was computed twice is apart by a share of the whole tree, however thin the twig. Limbs that begin
// beside one another at such a distance stay two.
TEST(Recover, JoinsThinTubesThatGoOnFromOneAnotherAlmostInOnePlace) {
  TubeMaker maker;
  maker.add(tube({0, 0, 0}, {0, 10, 0}, 5, 0.3, 0.2, 8));
  maker.add(tube({0, 5, 0}, {1, 5, 0}, 4, 0.002, 0.0019, 6));
  TubeShape next =
      tube({1, 5.00001, 0}, {2, 5, 0}, 4, 0.0019, 0.0018, 6);  // by half a per cent of its radius
  next.turn = 0.5;
  maker.add(next);
  EXPECT_EQ(recover(maker.mesh).radii.size(), 5u + 4u + 3u);
  TubeMaker beside;
  beside.add(tube({0, 0, 0}, {0, 10, 0}, 5, 0.3, 0.2, 8));
  beside.add(tube({0, 5, 0}, {1, 5, 0}, 4, 0.002, 0.0019, 6));
  next = tube({0, 5.00001, 0}, {1, 5.1, 0}, 4, 0.002, 0.0018, 6);
  next.turn = 0.5;
  beside.add(next);
  EXPECT_EQ(recover(beside.mesh).radii.size(), 5u + 4u + 4u);
}

TEST(Recover, LidsBelongToTheSegmentThatTheyClose) {
  TubeMaker maker;
  TubeShape shape = tube({0, 0, 0}, {0, 4, 0}, 3, 0.4, 0.3);
  shape.first = TubeEnd::fan;
  shape.last = TubeEnd::lid;
  maker.add(shape);
  const Hierarchy h = recover(maker.mesh);
  EXPECT_EQ(h.radii.size(), 3u);
  EXPECT_EQ(std::ranges::count(h.segment_of, 1u), 12 + 6);
  EXPECT_EQ(std::ranges::count(h.segment_of, 2u), 12 + 4);
}

RC_GTEST_PROP(Recover, IsSoundForAnySoup, ()) {
  const auto points = *rc::gen::inRange<std::uint32_t>(3, 30);
  std::vector<Double3> p;
  for (std::uint32_t i = 0; i < points; ++i) {
    p.push_back(
        {*rc::gen::inRange(0, 5) * 1.0, *rc::gen::inRange(0, 5) * 1.0, *rc::gen::inRange(0, 3) * 1.0});
  }
  const auto corner = [&] { return *rc::gen::inRange<std::uint32_t>(0, points); };
  std::vector<Triangle> t(*rc::gen::inRange<std::size_t>(0, 60));
  for (Triangle& triangle : t) triangle = {corner(), corner(), corner()};
  RC_ASSERT(static_cast<bool>(is_sound(mesh_of(p, t))));
}

TEST(Recover, OfATreeWithASecondShellInItsPlaceIsTheTree) {
  const Mesh mesh = little_tree(1, {});
  for (const bool flipped : {false, true}) {
    Mesh twice = mesh;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    twice.positions.insert(twice.positions.end(), mesh.positions.begin(), mesh.positions.end());
    for (const Triangle& t : mesh.triangles) {
      const Triangle copy{first + t[0], first + t[flipped ? 2 : 1], first + t[flipped ? 1 : 2]};
      twice.triangles.push_back(copy);
      twice.part_of.push_back(0);
    }
    const Hierarchy one = recover(mesh), two = recover(twice);
    EXPECT_TRUE(is_sound(twice));
    ASSERT_EQ(two.radii.size(), one.radii.size());
    for (std::size_t r = 0; r < one.radii.size(); ++r) EXPECT_EQ(two.radii[r].centre, one.radii[r].centre);
    EXPECT_EQ(std::ranges::count(two.segment_of, k_none), 2 * std::ranges::count(one.segment_of, k_none));
  }
}

TEST(Recover, GivesTheSameAnswerForTheSameMesh) {
  const Mesh mesh = little_tree(1, {});
  const Hierarchy a = recover(mesh), b = recover(mesh);
  ASSERT_EQ(a.radii.size(), b.radii.size());
  for (std::size_t r = 0; r < a.radii.size(); ++r) {
    EXPECT_EQ(a.radii[r].centre, b.radii[r].centre);
    EXPECT_EQ(a.radii[r].parent, b.radii[r].parent);
  }
  EXPECT_EQ(a.ring_vertices, b.ring_vertices);
  EXPECT_EQ(a.notes, b.notes);
}

}  // namespace
}  // namespace copse
