#include "lib/analysis/lod/edge_collapse.h"

#include "lib/analysis/lod/edge_spectrum.h"
#include "tests/lod/edge_shapes.h"

#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

namespace copse {
namespace {

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
