#include "lib/runtime/stochastic_levels.h"

#include "lib/formats/random.h"

#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

// Bark: `bark` triangles of 0.01 m^2; leaves: `leaves` of about a quarter of that; in a box of 10 m.
TreeGeometry tree(std::uint32_t bark, std::uint32_t leaves) {
  TreeGeometry g;
  Random random(7);
  const auto add = [&](std::uint32_t count, double size) {
    for (std::uint32_t t = 0; t < count; ++t) {
      const Double3 at{random.uniform(-5, 5), random.uniform(0, 10), random.uniform(-5, 5)};
      const double s = size * random.uniform(0.8, 1.2);
      for (const Double3& p : {at, at + Double3{s, 0, 0}, at + Double3{0, 2 * s, s}}) {
        g.indices.push_back(static_cast<std::uint32_t>(g.vertices.size()));
        g.vertices.push_back({to_float(p), {0, 1, 0}, {static_cast<float>(t), 0}});
        g.bounds.grow(to_float(p));
      }
    }
  };
  add(bark, 0.1), add(leaves, 0.05);
  g.ranges = {{DrawPart::trunk, 3, 0, 3 * bark}, {DrawPart::leaves, 5, 3 * bark, 3 * leaves}};
  return g;
}

double area(const TreeGeometry& g, const DrawRange& range) {
  double sum = 0;
  for (std::size_t i = range.first_index; i < range.first_index + range.index_count; i += 3) {
    const auto at = [&](std::size_t k) { return to_double(g.vertices[g.indices[i + k]].position); };
    sum += length(cross(at(1) - at(0), at(2) - at(0))) / 2;
  }
  return sum;
}

std::uint32_t triangles(const std::vector<DrawRange>& ranges) {
  std::uint32_t sum = 0;
  for (const DrawRange& r : ranges) sum += r.index_count / 3;
  return sum;
}

TEST(StochasticLevels, FewTrianglesHaveTheAreaOfAll) {
  for (const std::uint32_t wanted : {1024u, 256u, 64u}) {
    TreeGeometry g = tree(500, 3000);
    const std::vector<DrawRange> full = g.ranges, level = add_stochastic_level(g, full, wanted);
    ASSERT_EQ(level.size(), 2u);
    EXPECT_LE(triangles(level), wanted);
    EXPECT_GE(triangles(level), wanted - 2);
    for (std::size_t r = 0; r < 2; ++r) {
      EXPECT_EQ(level[r].part, full[r].part);
      EXPECT_EQ(level[r].material, full[r].material);
      // Less by what would have left the box.
      EXPECT_LE(area(g, level[r]), 1.001 * area(g, full[r])) << wanted;
      EXPECT_GE(area(g, level[r]), 0.75 * area(g, full[r])) << wanted;
    }
  }
}

TEST(StochasticLevels, NothingLeavesTheBox) {
  TreeGeometry g = tree(40, 4000);
  const std::size_t before = g.vertices.size();
  for (const std::uint32_t wanted : {256u, 16u, 2u}) add_stochastic_level(g, g.ranges, wanted);
  for (std::size_t v = before; v < g.vertices.size(); ++v)
    for (int a = 0; a < 3; ++a) {
      EXPECT_GE(g.vertices[v].position[a], g.bounds.min[a]);
      EXPECT_LE(g.vertices[v].position[a], g.bounds.max[a]);
    }
}

TEST(StochasticLevels, TrianglesKeepTheirTextureCoordinatesAndDirections) {
  TreeGeometry g = tree(10, 1000);
  const std::vector<DrawRange> level = add_stochastic_level(g, g.ranges, 30);
  for (const DrawRange& r : level)
    for (std::size_t i = r.first_index; i < r.first_index + r.index_count; i += 3) {
      const auto v = [&](std::size_t k) { return g.vertices[g.indices[i + k]]; };
      EXPECT_EQ(v(0).texcoord, v(1).texcoord) << "of one triangle of the tree";
      const Double3 n =
          cross(to_double(v(1).position - v(0).position), to_double(v(2).position - v(0).position));
      EXPECT_NEAR(std::abs(dot(normalized(n), normalized(Double3{0, -1, 2}))), 1, 1e-4);
    }
}

TEST(StochasticLevels, WhatHasFewTrianglesStaysAsItIs) {
  TreeGeometry g = tree(3, 10);
  const std::size_t vertices = g.vertices.size();
  EXPECT_EQ(add_stochastic_level(g, g.ranges, 13), g.ranges);
  EXPECT_EQ(g.vertices.size(), vertices);
  EXPECT_TRUE(add_stochastic_level(g, {}, 4).empty());
}

TEST(StochasticLevels, RangesWithoutAnAreaAreLeftOut) {
  TreeGeometry g = tree(5, 50);
  for (std::size_t i = 0; i < 15; ++i) g.vertices[g.indices[i]].position = {0, 1, 0};
  const std::vector<DrawRange> level = add_stochastic_level(g, g.ranges, 8);
  ASSERT_EQ(level.size(), 1u);
  EXPECT_EQ(level[0].part, DrawPart::leaves);
  for (DrawVertex& v : g.vertices) v.position = {};
  EXPECT_TRUE(add_stochastic_level(g, g.ranges, 8).empty());
}

TEST(StochasticLevels, TheSameGeometryGivesTheSameLevel) {
  TreeGeometry a = tree(100, 1000), b = a;
  EXPECT_EQ(add_stochastic_level(a, a.ranges, 64), add_stochastic_level(b, b.ranges, 64));
  EXPECT_EQ(a.vertices, b.vertices);
}

TEST(StochasticLevels, ATriangleAPixel) {
  EXPECT_EQ(triangles_of_pixels(16), 256u);
  EXPECT_EQ(triangles_of_pixels(0), 1u);
  EXPECT_EQ(triangles_of_pixels(1e30), 1000000000u);
}

}  // namespace
}  // namespace copse
