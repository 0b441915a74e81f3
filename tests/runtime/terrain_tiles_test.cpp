#include "lib/runtime/terrain_tiles.h"

#include "lib/formats/random.h"

#include <algorithm>
#include <map>

#include <gtest/gtest.h>

namespace copse {
namespace {

Terrain hills(std::uint32_t columns, std::uint32_t rows) {
  Terrain t;
  t.columns = columns, t.rows = rows;
  t.origin = {100, 5, -40};
  t.spacing_x = 1.5, t.spacing_z = 2;
  Random random(columns);
  std::vector<float> heights(t.vertex_count());
  for (std::uint32_t r = 0; r < rows; ++r)
    for (std::uint32_t c = 0; c < columns; ++c)
      heights[std::size_t{r} * columns + c] =
          static_cast<float>(9 * std::sin(c * 0.05) * std::cos(r * 0.04) + random.uniform(-0.1, 0.1));
  t.heights = std::move(heights);
  return t;
}

Frustum everything() {
  Frustum f;
  for (Plane& p : f) p = {{0, 1, 0}, 1e30};
  return f;
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

// How often each edge occurs, the lower vertex first.
std::map<Edge, int> edges_of(const std::vector<std::uint32_t>& indices) {
  std::map<Edge, int> edges;
  for (std::size_t t = 0; t < indices.size(); t += 3)
    for (std::size_t k = 0; k < 3; ++k) ++edges[std::minmax(indices[t + k], indices[t + (k + 1) % 3])];
  return edges;
}

// Twice the area seen from above, in cells; positive when counter-clockwise seen from there (z points down).
double area(const Terrain& t, const std::uint32_t* corner) {
  const auto column = [&](std::uint32_t v) { return static_cast<double>(v % t.columns); };
  const auto row = [&](std::uint32_t v) {
    const std::uint32_t whole = v / t.columns;
    return static_cast<double>(whole);
  };
  const double x1 = column(corner[1]) - column(corner[0]), z1 = row(corner[1]) - row(corner[0]);
  const double x2 = column(corner[2]) - column(corner[0]), z2 = row(corner[2]) - row(corner[0]);
  return z1 * x2 - x1 * z2;
}

TEST(TerrainTiles, WithoutToleranceAllOfItIsDrawn) {
  const Terrain t = hills(130, 70);
  TerrainTiles tiles(t);
  EXPECT_EQ(tiles.tile_count(), 6u);
  tiles.choose({100, 10, -40}, 0);
  std::vector<std::uint32_t> indices;
  tiles.append(everything(), {}, indices);
  EXPECT_EQ(indices.size(), 3u * 2 * 129 * 69);
}

// Whatever the levels: no cracks, no T-junctions, nothing twice, nothing upside down.
TEST(TerrainTiles, TheSurfaceHasNoCracksAndCoversTheTerrainOnce) {
  for (const auto& [columns, rows] : {std::pair(257u, 193u), {200u, 131u}, {2u, 2u}, {66u, 3u}, {65u, 65u}}) {
    const Terrain t = hills(columns, rows);
    TerrainTiles tiles(t);
    Random random(7);
    for (int n = 0; n < 20; ++n) {
      tiles.choose({random.uniform(50, 500), random.uniform(5, 60), random.uniform(-80, 400)},
                   std::pow(10, random.uniform(-4, 0)));
      std::vector<std::uint32_t> indices, border;
      tiles.append(everything(), {}, indices);
      tiles.append_border(border);
      double sum = 0;
      for (std::size_t k = 0; k < indices.size(); k += 3) {
        EXPECT_GT(area(t, &indices[k]), 0);
        sum += area(t, &indices[k]);
      }
      EXPECT_EQ(sum, 2.0 * (columns - 1) * (rows - 1));
      std::map<Edge, int> edges = edges_of(indices);
      for (std::size_t k = 0; k < border.size(); ++k) {
        const auto at = edges.find(std::minmax(border[k], border[(k + 1) % border.size()]));
        ASSERT_NE(at, edges.end());
        EXPECT_EQ(at->second, 1);
        edges.erase(at);
      }
      for (const auto& [edge, count] : edges) EXPECT_EQ(count, 2);
    }
  }
}

// The judge interpolates in the triangle that covers a vertex's place.
TEST(TerrainTiles, NoVertexIsFartherOffThanTheErrorsSay) {
  const Terrain t = hills(193, 129);
  TerrainTiles tiles(t);
  tiles.choose({100, 8, -40}, 0.004);
  double allowed = 0, worst = 0;
  bool coarse = false;
  for (std::size_t k = 0; k < tiles.tile_count(); ++k) {
    for (std::uint32_t level = 1; level < k_terrain_levels; ++level)
      EXPECT_GE(tiles.error(k, level), tiles.error(k, level - 1));
    allowed = std::max(allowed, tiles.error(k, tiles.level(k)));
    coarse |= tiles.level(k) > 2;
  }
  EXPECT_TRUE(coarse);
  EXPECT_GT(allowed, 0.1);
  std::vector<std::uint32_t> indices;
  tiles.append(everything(), {}, indices);
  for (std::size_t k = 0; k < indices.size(); k += 3) {
    const std::uint32_t* v = &indices[k];
    std::uint32_t c0 = t.columns, c1 = 0, r0 = t.rows, r1 = 0;
    for (int i = 0; i < 3; ++i) {
      c0 = std::min(c0, v[i] % t.columns), c1 = std::max(c1, v[i] % t.columns);
      r0 = std::min(r0, v[i] / t.columns), r1 = std::max(r1, v[i] / t.columns);
    }
    for (std::uint32_t r = r0; r <= r1; ++r)
      for (std::uint32_t c = c0; c <= c1; ++c) {
        const std::uint32_t here = r * t.columns + c;
        double weight[3];
        bool inside = true;
        for (int i = 0; i < 3; ++i) {
          const std::uint32_t part[3] = {here, v[(i + 1) % 3], v[(i + 2) % 3]};
          weight[i] = area(t, part) / area(t, v);
          inside &= weight[i] >= 0;
        }
        if (!inside) continue;
        double height = 0;
        for (int i = 0; i < 3; ++i) height += weight[i] * t.vertex(v[i] % t.columns, v[i] / t.columns).y;
        worst = std::max(worst, std::abs(height - t.vertex(c, r).y));
      }
  }
  EXPECT_LE(worst, allowed * (1 + 1e-6));
  EXPECT_GT(worst, 0.02);
}

TEST(TerrainTiles, WhatIsNearIsFinerThanWhatIsFar) {
  const Terrain t = hills(513, 513);
  TerrainTiles tiles(t);
  const Double3 eye{100, 10, -40};
  tiles.choose(eye, 0.002);
  EXPECT_EQ(tiles.level(0), 0u);  // the eye is over it
  EXPECT_GT(tiles.level(tiles.tile_count() - 1), 1u);
  std::vector<std::uint32_t> some, all;
  tiles.append(everything(), eye, all);
  const View view = make_view({.eye = eye, .target = eye + Double3{1, 0, 1}, .fov = 0.5}, 1, 0.1, 1e4);
  tiles.append(frustum_of(view), eye, some);
  EXPECT_LT(some.size(), all.size());
  EXPECT_GT(some.size(), 0u);
  EXPECT_LT(all.size(), 6u * 512 * 512 / 2);
}

TEST(TerrainTiles, AFreeSurfaceIsMeasuredInSpace) {
  Terrain t;
  t.columns = t.rows = 3;
  std::vector<Float3> points;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) points.push_back({static_cast<float>(c), 0, static_cast<float>(r)});
  points[4] = {1.5f, 1, 1};  // half a metre aside and one up
  t.points = points;
  TerrainTiles tiles(t);
  EXPECT_NEAR(tiles.error(0, 1), std::sqrt(1.25), 1e-6);
}

TEST(TerrainTiles, OfNoTerrainNothingIsDrawn) {
  TerrainTiles none(Terrain{});
  none.choose({}, 1);
  std::vector<std::uint32_t> indices;
  none.append(everything(), {}, indices);
  none.append_border(indices);
  EXPECT_TRUE(indices.empty());
}

}  // namespace
}  // namespace copse
