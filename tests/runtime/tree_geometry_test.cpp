#include "lib/runtime/tree_geometry.h"

#include "tests/runtime/little_tree.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace copse {
namespace {

using testing::little_stree;
using testing::little_tree;

using Positions = std::array<Float3, 3>;

Positions positions(const TreeGeometry& g, std::size_t triangle) {
  const auto at = [&](std::size_t c) { return g.vertices[g.indices[3 * triangle + c]].position; };
  return {at(0), at(1), at(2)};
}

bool less(const Positions& a, const Positions& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      if (a[i][k] != b[i][k]) return a[i][k] < b[i][k];
    }
  }
  return false;
}

std::vector<Positions> sorted_triangles(const TreeGeometry& g) {
  std::vector<Positions> all(g.indices.size() / 3);
  for (std::size_t t = 0; t < all.size(); ++t) all[t] = positions(g, t);
  std::sort(all.begin(), all.end(), less);
  return all;
}

TEST(TreeGeometry, HoldsEveryTriangleExactlyOnce) {
  const Tree tree = little_stree();
  const TreeGeometry g = make_geometry(tree);
  std::vector<Positions> expected;
  const std::vector<Float3> trunk = trunk_vertices(tree);
  for (const CornerTriangle& t : tree.trunk.triangles) {
    expected.push_back({trunk[t.vertex[0]], trunk[t.vertex[1]], trunk[t.vertex[2]]});
  }
  const Array<Float3>& leaf = tree.leaves.vertices;
  for (const CornerTriangle& t : tree.leaves.triangles) {
    expected.push_back({leaf[t.vertex[0]], leaf[t.vertex[1]], leaf[t.vertex[2]]});
  }
  std::sort(expected.begin(), expected.end(), less);
  EXPECT_EQ(sorted_triangles(g), expected);
}

TEST(TreeGeometry, OfATreeAndOfItsStreeIsTheSame) {
  const TreeGeometry a = make_geometry(little_tree()), b = make_geometry(little_stree());
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.indices, b.indices);
  EXPECT_EQ(a.ranges, b.ranges);
}

TEST(TreeGeometry, KeepsTheOrderOfTheTrunkAndPutsLeavesInTheOrderOfTheirGroup) {
  const TreeGeometry g = make_geometry(little_stree());
  ASSERT_EQ(g.ranges.size(), 2u);
  EXPECT_EQ(g.ranges[0], (DrawRange{DrawPart::trunk, 0, 0, 48}));
  EXPECT_EQ(g.ranges[1], (DrawRange{DrawPart::leaves, 1, 48, 12}));
  EXPECT_EQ(positions(g, 0)[0], (Float3{0.15f, 1, 0})) << "the thin segment 1-2 comes first";
  EXPECT_EQ(positions(g, 8)[0], (Float3{0.2f, 0, 0}));
  EXPECT_EQ(positions(g, 16)[0], (Float3{-0.5f, 2, 0})) << "leaf 1 stands first in the group";
}

TEST(TreeGeometry, SharesVerticesThatAgreeAndSplitsThoseThatDoNot) {
  const TreeGeometry g = make_geometry(little_stree());
  // The square tube's smooth normals differ from each face by 45 degrees: below the crease, so rings are
  // shared.
  EXPECT_EQ(std::count_if(g.vertices.begin(), g.vertices.end(),
                          [](const DrawVertex& v) { return v.position.y < 2; }),
            8);
  const std::size_t leaves = 8;
  EXPECT_EQ(g.vertices.size(), 12 + leaves);
}

TEST(TreeGeometry, ComputesNormalsThatPointOutOfATube) {
  const TreeGeometry g = make_geometry(little_stree());
  const DrawVertex& v = g.vertices[g.indices[8 * 3]];
  ASSERT_EQ(v.position, (Float3{0.2f, 0, 0}));
  EXPECT_GT(v.normal.x, 0.99f);
  for (const DrawVertex& vertex : g.vertices) EXPECT_NEAR(length(to_double(vertex.normal)), 1, 1e-6);
}

TEST(TreeGeometry, KeepsACreaseSharperThanSixtyDegrees) {
  // Two squares that share an edge at a right angle, seen from outside: each keeps its own normal... unless
  // their mean is within 60 degrees of both (45 here), so a cube's edge is smooth but a folded card is not.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0.1}, {1, 0, -0.1}};
  mesh.triangles = {{0, 2, 1}, {1, 3, 0}};
  const TreeGeometry g = make_geometry(mesh);
  ASSERT_EQ(g.indices.size(), 6u);
  for (std::size_t t = 0; t < 2; ++t) {
    const Positions p = positions(g, t);
    const Double3 face = normalized(cross(to_double(p[1] - p[0]), to_double(p[2] - p[0])));
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_GT(dot(face, to_double(g.vertices[g.indices[3 * t + c]].normal)), 0.999);
    }
  }
  EXPECT_EQ(g.vertices.size(), 6u);
}

TEST(TreeGeometry, KeepsStoredNormalsAndMakesThemUnitLength) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.normals = {{0, 3, 4}, {0, 0, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.normal_triangles = {{0, 1, k_none}};
  const TreeGeometry g = make_geometry(mesh);
  EXPECT_NEAR(g.vertices[0].normal.y, 0.6f, 1e-6f);
  EXPECT_EQ(g.vertices[1].normal, (Float3{0, 0, 1})) << "a normal of length 0 gives way to the face's";
  EXPECT_EQ(g.vertices[2].normal, (Float3{0, 0, 1}));
}

TEST(TreeGeometry, SortsAMeshByMaterialAndKeepsTheOrderInside) {
  Mesh mesh;
  mesh.materials.resize(2);
  mesh.parts = {{"", "", 1}, {"", "", 0}, {"", "", k_none}};
  for (int t = 0; t < 6; ++t) {
    const auto v = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {{1.0 * t, 0, 0}, {t + 1.0, 0, 0}, {1.0 * t, 1, 0}});
    mesh.triangles.push_back({v, v + 1, v + 2});
    mesh.part_of.push_back(static_cast<std::uint32_t>(t % 3));
  }
  const TreeGeometry g = make_geometry(mesh);
  ASSERT_EQ(g.ranges.size(), 3u);
  EXPECT_EQ(g.ranges[0], (DrawRange{DrawPart::mesh, 0, 0, 6}));
  EXPECT_EQ(g.ranges[1], (DrawRange{DrawPart::mesh, 1, 6, 6}));
  EXPECT_EQ(g.ranges[2], (DrawRange{DrawPart::mesh, k_none, 12, 6}));
  EXPECT_EQ(positions(g, 0)[0].x, 1);
  EXPECT_EQ(positions(g, 1)[0].x, 4);
}

TEST(TreeGeometry, AMeshFarFromTheOriginKeepsItsShape) {
  Mesh mesh;
  const Double3 far{1e7, 1e7, 1e7};
  mesh.positions = {far, far + Double3{0.001, 0, 0}, far + Double3{0, 0.001, 0}};
  mesh.triangles = {{0, 1, 2}};
  const TreeGeometry g = make_geometry(mesh);
  const Positions p = positions(g, 0);
  EXPECT_NEAR(p[1].x - p[0].x, 0.001f, 1e-8f);
  EXPECT_NEAR(distance(g.origin + to_double(p[0]), far), 0, 1e-8);
}

TEST(TreeGeometry, AMeshWithADegenerateTriangleHasFiniteNormals) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}};
  mesh.triangles = {{0, 1, 1}, {0, 0, 0}};
  const TreeGeometry g = make_geometry(mesh);
  ASSERT_EQ(g.indices.size(), 6u);
  for (const DrawVertex& v : g.vertices) EXPECT_EQ(v.normal, (Float3{0, 1, 0}));
}

TEST(TreeGeometry, EmptyStaysEmpty) {
  const TreeGeometry g = make_geometry(Tree{});
  EXPECT_TRUE(g.vertices.empty());
  EXPECT_TRUE(g.ranges.empty());
  EXPECT_TRUE(g.bounds.empty());
  EXPECT_TRUE(make_geometry(Mesh{}).ranges.empty());
}

TEST(TreeGeometry, OneHubWithAHundredThousandCornersIsQuick) {
  Mesh mesh;
  mesh.positions.push_back({});
  for (int i = 0; i <= 100000; ++i) {
    const double a = i * 1e-4;
    mesh.positions.push_back({std::cos(a), std::sin(a), 0});
  }
  for (std::uint32_t i = 1; i <= 100000; ++i) mesh.triangles.push_back({0, i, i + 1});
  const TreeGeometry g = make_geometry(mesh);
  EXPECT_EQ(g.vertices.size(), mesh.positions.size());
}

}  // namespace
}  // namespace copse
