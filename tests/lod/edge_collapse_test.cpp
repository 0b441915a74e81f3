#include "lib/analysis/lod/edge_collapse.h"

#include "lib/formats/level_mesh.h"

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

namespace copse {
namespace {

// A grid of n x n squares over [0, 1]^2, its heights given; texture coordinates as the place.
template <class Height>
PartTriangles grid(std::uint32_t n, Height height) {
  PartTriangles mesh;
  for (std::uint32_t y = 0; y <= n; ++y) {
    for (std::uint32_t x = 0; x <= n; ++x) {
      const double u = static_cast<double>(x) / n, v = static_cast<double>(y) / n;
      mesh.vertices.push_back(
          {to_float({u, height(u, v), v}), {0, 1, 0}, {static_cast<float>(u), static_cast<float>(v)}});
      mesh.position_of.push_back(y * (n + 1) + x);
    }
  }
  for (std::uint32_t y = 0; y < n; ++y) {
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t a = y * (n + 1) + x, b = a + 1, c = a + n + 1, d = c + 1;
      mesh.triangles.push_back({a, c, b}), mesh.triangles.push_back({b, c, d});
    }
  }
  mesh.materials.assign(mesh.triangles.size(), 0);
  return mesh;
}

// A closed torus; with `seam` the texture wraps along one circle, whose vertices are there twice.
PartTriangles torus(std::uint32_t n, std::uint32_t m, bool seam) {
  PartTriangles mesh;
  const auto add = [&](std::uint32_t i, std::uint32_t j, float u) {
    const double a = 2 * std::numbers::pi * i / n, b = 2 * std::numbers::pi * j / m;
    const Double3 out{std::cos(a) * std::cos(b), std::sin(b), std::sin(a) * std::cos(b)};
    mesh.vertices.push_back(
        {to_float(Double3{std::cos(a), 0, std::sin(a)} * 2.0 + out * 0.7), to_float(out), {u, 0.5f}});
    mesh.position_of.push_back(i % n * m + j);
  };
  const std::uint32_t rows = seam ? n + 1 : n;
  for (std::uint32_t i = 0; i < rows; ++i)
    for (std::uint32_t j = 0; j < m; ++j) add(i, j, seam ? static_cast<float>(i) / static_cast<float>(n) : 0);
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < m; ++j) {
      const std::uint32_t a = i * m + j, b = i * m + (j + 1) % m, k = (i + 1) % rows, c = k * m + j,
                          d = k * m + (j + 1) % m;
      mesh.triangles.push_back({a, b, c}), mesh.triangles.push_back({b, d, c});
    }
  }
  mesh.materials.assign(mesh.triangles.size(), 0);
  return mesh;
}

// Vertices - edges + faces over places; and whether every edge has exactly two faces, one each way.
struct Topology {
  int euler = 0;
  bool closed = true;
};
Topology topology(const PartTriangles& mesh, const CollapsedState& state) {
  std::set<std::uint32_t> places;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : state.triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t a = mesh.position_of[t[c]], b = mesh.position_of[t[(c + 1) % 3]];
      places.insert(a);
      ++edges[{a, b}];
    }
  }
  Topology out;
  std::size_t undirected = 0;
  for (const auto& [edge, count] : edges) {
    const bool other = edges.contains({edge.second, edge.first});
    undirected += edge.first < edge.second || !other;
    if (count != 1 || !other) out.closed = false;
  }
  out.euler = static_cast<int>(places.size()) - static_cast<int>(undirected) +
              static_cast<int>(state.triangles.size());
  return out;
}

TEST(EdgeCollapse, AFlatGridBecomesAlmostNothingWithoutError) {
  const PartTriangles mesh = grid(16, [](double, double) { return 0.0; });
  const EdgeCollapses c = collapse_edges(mesh);
  EXPECT_LE(c.triangles, 8u);
  const CollapsedState at_eight = collapsed_state(mesh, c, c.size());
  double area = 0;
  for (const auto& t : at_eight.triangles) {
    const Double3 p = to_double(mesh.vertices[t[0]].position), q = to_double(mesh.vertices[t[1]].position),
                  r = to_double(mesh.vertices[t[2]].position);
    area += 0.5 * length(cross(q - p, r - p));
    EXPECT_GT(cross(q - p, r - p).y, 0);  // none is turned over
  }
  EXPECT_NEAR(area, 1, 1e-3);  // the border stays
}

TEST(EdgeCollapse, GenusAndManifoldnessStayAtEveryState) {
  for (const bool seam : {false, true}) {
    const PartTriangles mesh = torus(24, 12, seam);
    const EdgeCollapses c = collapse_edges(mesh, {.max_error = 1});
    for (std::size_t n = 0; n <= c.size(); n += 7) {
      const Topology t = topology(mesh, collapsed_state(mesh, c, n));
      ASSERT_EQ(t.euler, 0) << seam << " " << n;
      ASSERT_TRUE(t.closed) << seam << " " << n;
    }
    EXPECT_LT(c.triangles, mesh.triangles.size() / 4) << seam;
  }
}

TEST(EdgeCollapse, SeamsStayClosedAndKeepTheirTexture) {
  const PartTriangles mesh = torus(24, 12, true);
  const EdgeCollapses c = collapse_edges(mesh, {.max_error = 1});
  const CollapsedState state = collapsed_state(mesh, c, c.size());
  for (const auto& t : state.triangles) {
    // No triangle spans the whole texture, as one would that took the wrong side of the seam.
    float low = 2, high = -1;
    for (const std::uint32_t v : t)
      low = std::min(low, mesh.vertices[v].texcoord.x), high = std::max(high, mesh.vertices[v].texcoord.x);
    EXPECT_LT(high - low, 0.75f);
  }
}

TEST(EdgeCollapse, ErrorsGrowWithCurvature) {
  const PartTriangles mesh =
      grid(24, [](double u, double v) { return 0.1 * std::sin(6 * u) * std::cos(5 * v); });
  const Spectrum s = edge_spectrum(mesh, collapse_edges(mesh), {});
  ASSERT_GT(s.steps(), 100u);
  std::uint32_t half = 0;
  while (s.counts[half] > s.counts[0] / 2) ++half;
  EXPECT_LT(s.errors[half], 0.005);
  EXPECT_GT(s.errors[s.steps()], s.errors[half]);
}

TEST(EdgeCollapse, TheSpectrumIsTheStatesOneByOne) {
  const PartTriangles mesh = torus(12, 8, true);
  const EdgeCollapses c = collapse_edges(mesh, {.max_error = 1});
  const Spectrum s = edge_spectrum(mesh, c, {});
  ASSERT_EQ(s.steps(), c.size());
  for (std::uint32_t n = 0; n <= s.steps(); n += 5) {
    EXPECT_EQ(s.counts[n], collapsed_state(mesh, c, n).triangles.size());
    Mesh state;
    append_state(state, s, n, "torus");
    EXPECT_EQ(state.triangles.size(), s.counts[n]);
  }
}

TEST(EdgeCollapse, StopsAtTheLeastNumberOfTriangles) {
  const PartTriangles mesh = torus(24, 12, false);
  const EdgeCollapses c = collapse_edges(mesh, {.max_error = 1, .min_triangles = 200});
  EXPECT_LE(c.triangles, 200u);
  EXPECT_GE(c.triangles, 198u);
}

TEST(EdgeCollapse, NothingAndDegenerateFacesAreNoTrouble) {
  EXPECT_EQ(collapse_edges({}).size(), 0u);
  PartTriangles one = grid(1, [](double, double) { return 0.0; });
  one.triangles.push_back({0, 0, 1}), one.triangles.push_back({1, 1, 1});
  one.triangles.push_back(one.triangles[0]);  // there twice
  one.materials.assign(one.triangles.size(), 0);
  EXPECT_LE(collapse_edges(one).triangles, 3u);
  PartTriangles flat = grid(4, [](double, double) { return 0.0; });
  for (SpectrumVertex& v : flat.vertices) v.position = {1, 1, 1};  // all in one place
  EXPECT_LE(collapse_edges(flat).triangles, 32u);
}

TEST(EdgeCollapse, ScaleAndPlaceChangeNothing) {
  const auto wave = [](double u, double v) { return 0.1 * std::sin(6 * u) * std::cos(5 * v); };
  const PartTriangles mesh = grid(12, wave);
  PartTriangles large = mesh;
  for (SpectrumVertex& v : large.vertices) v.position = v.position * 1024.0f;
  const EdgeCollapses a = collapse_edges(mesh), b = collapse_edges(large);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.wedges.size(); ++i) EXPECT_EQ(a.wedges[i].thrown, b.wedges[i].thrown) << i;
  EXPECT_NEAR(b.errors.back() / a.errors.back(), 1024, 1);
}

}  // namespace
}  // namespace copse
