#include "lib/analysis/lod/trunk_radii.h"

#include "lib/analysis/lod/limb_chains.h"
#include "lib/analysis/measure/raster.h"
#include "lib/formats/levels/level_mesh.h"
#include "lib/formats/levels/part_triangles.h"
#include "tests/lod/tube_tree.h"

#include <cmath>
#include <filesystem>
#include <numbers>

#include <gtest/gtest.h>

namespace copse {
namespace {

double area(const Mesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles)
    sum += 0.5 * length(cross(mesh.positions[t[1]] - mesh.positions[t[0]],
                              mesh.positions[t[2]] - mesh.positions[t[0]]));
  return sum;
}

std::uint32_t step_for(const Spectrum& s, double ratio) {
  std::uint32_t n = 0;
  while (n < s.steps() && s.counts[n] > ratio * s.counts[0]) ++n;
  return n;
}

double covered(const Mesh& mesh, const DoubleBox& box) {
  double pixels = 0;
  for (int view = 0; view < 6; ++view) {
    const Raster r = rasterize(mesh.positions, mesh.triangles, frame_box(box, view * 0.5236, 256, 256));
    for (const std::uint32_t t : r.triangle) pixels += t != k_none;
  }
  return pixels;
}

TEST(TrunkRadii, StartsWithTheTreesOwnTriangles) {
  const Tree tree = stem_with_twigs(8, 8, 5);
  const Spectrum s = trunk_by_radii(tree);
  EXPECT_EQ(s.counts[0], tree.trunk.triangles.size());
  Mesh mesh;
  append_state(mesh, s, 0, "trunk");
  const PartTriangles full = trunk_triangles(tree);
  double expected = 0;
  for (const auto& t : full.triangles) {
    const Double3 a = to_double(full.vertices[t[0]].position), b = to_double(full.vertices[t[1]].position),
                  c = to_double(full.vertices[t[2]].position);
    expected += 0.5 * length(cross(b - a, c - a));
  }
  EXPECT_NEAR(area(mesh), expected, 1e-4 * expected);
}

TEST(TrunkRadii, GoesDownToNothingWithoutAFloor) {
  const Spectrum s = trunk_by_radii(stem_with_twigs(8, 8, 20));
  EXPECT_EQ(s.counts[s.steps()], 0u);
  for (std::uint32_t n = 1; n <= s.steps(); ++n) {
    EXPECT_LE(s.counts[n], s.counts[n - 1]);
    EXPECT_GE(s.errors[n], s.errors[n - 1]);
  }
}

TEST(TrunkRadii, KeepsTheCoverageAtATenth) {
  const Spectrum s = trunk_by_radii(stem_with_twigs(30, 12, 10));
  Mesh full, tenth;
  append_state(full, s, 0, "trunk");
  append_state(tenth, s, step_for(s, 0.1), "trunk");
  EXPECT_LE(tenth.triangles.size(), full.triangles.size() / 10);
  const DoubleBox box = bounds(full);
  EXPECT_NEAR(covered(tenth, box) / covered(full, box), 1, 0.05);
}

// A stem, 10 m high and .4 thick up to its half, and boughs of 4 m above.
Tree stem_with_boughs(int boughs) {
  Tube tube;
  std::vector<std::uint32_t> stem;
  for (int i = 0; i < 20; ++i)
    stem.push_back(
        tube.add_ring({0, i * 0.5, 0}, i < 10 ? 0.2 : 0.02 * (20 - i), 8, i == 0 ? k_none : stem.back()));
  for (int b = 0; b < boughs; ++b) {
    const double a = b * 2.4;
    std::uint32_t before = stem[10 + static_cast<std::size_t>(b) % 8];
    const Double3 from = tube.hierarchy.radii[before].centre;
    for (int i = 0; i < 9; ++i)
      before = tube.add_ring(from + Double3{std::cos(a + 0.1 * i) * 0.4 * i, 0.05 * i * i + 0.3,
                                            std::sin(a + 0.1 * i) * 0.4 * i},
                             0.05 - 0.004 * i, 6, before, i == 0);
  }
  return tree_of(tube);
}

// A ribbon would be there from two sides and gone from the other two.
TEST(TrunkRadii, AStemIsSeenFromAllSidesAtATenthAndBelow) {
  const Spectrum s = trunk_by_radii(stem_with_boughs(20));
  for (const double ratio : {0.1, 0.03, 0.01}) {
    Mesh mesh;
    append_state(mesh, s, step_for(s, ratio), "trunk");
    for (int view = 0; view < 16; ++view) {
      const double a = view * std::numbers::pi / 16;
      double low = 1e9, high = -1e9;
      for (const Triangle& t : mesh.triangles)
        for (const std::uint32_t v : t) {
          const Double3& p = mesh.positions[v];
          if (p.y > 1) continue;  // the foot of the stem
          const double x = p.x * std::cos(a) + p.z * std::sin(a);
          low = std::min(low, x), high = std::max(high, x);
        }
      EXPECT_GT(high - low, 0.2) << ratio << " " << view;
    }
  }
}

TEST(TrunkRadii, ALimbOutlivesWhatGrowsFromIt) {
  const Tree tree = stem_with_twigs(8, 8, 20);
  const Spectrum s = trunk_by_radii(tree);
  const std::vector<LimbChain> limbs = limb_chains(tree);
  std::vector<std::uint32_t> limb_of(tree.radius_count(), k_none);
  for (std::uint32_t l = 0; l < limbs.size(); ++l)
    for (std::size_t i = 1; i < limbs[l].radii.size(); ++i) limb_of[limbs[l].radii[i]] = l;
  std::vector<std::uint32_t> death(limbs.size(), 0);
  for (const SpectrumElement& e : s.elements)
    death[limb_of[e.radius]] = std::max(death[limb_of[e.radius]], e.death);
  for (std::size_t l = 0; l < limbs.size(); ++l) {
    if (limbs[l].parent == k_none) continue;
    EXPECT_LE(death[l], death[limbs[l].parent]) << l;
  }
}

TEST(TrunkRadii, OfTwoTwigsThatAreAlikeTheOneThatBearsLeavesStaysLonger) {
  const Tree bare = stem_with_twigs(8, 8, 2);
  std::vector<std::uint32_t> tips;
  for (std::uint32_t r = 0; r < bare.radius_count(); ++r)
    if ((bare.hierarchy.radii[r].flags & Radius::terminal) && bare.hierarchy.radii[r].diameter < 0.2)
      tips.push_back(r);
  ASSERT_EQ(tips.size(), 2u);
  for (const std::size_t bearer : {0u, 1u}) {
    Tree tree = bare;
    std::vector<Radius> radii = tree.hierarchy.radii.to_vector();
    radii[tips[bearer]].first_child = 0, radii[tips[bearer]].child_count = 1;
    tree.hierarchy.radii = radii;
    const Spectrum s = trunk_by_radii(tree);
    std::uint32_t gone[2] = {0, 0};
    for (const SpectrumElement& e : s.elements)
      for (const std::size_t twig : {0u, 1u})
        if (e.radius == tips[twig]) gone[twig] = std::max(gone[twig], e.death);
    EXPECT_GT(gone[bearer], gone[1 - bearer]);
  }
}

TEST(TrunkRadii, ByDiameterThinLimbsAreGoneBeforeThickOnesChange) {
  const Tree tree = stem_with_twigs(8, 8, 20);
  const Spectrum s = trunk_by_radii(tree, {.order = RemovalOrder::diameter});
  const std::vector<LimbChain> limbs = limb_chains(tree);
  std::uint32_t first_of_stem = k_none, last_of_twigs = 0;
  for (const SpectrumElement& e : s.elements) {
    const auto& stem = limbs[0].radii;
    const bool in_stem = std::find(stem.begin(), stem.end(), e.radius) != stem.end();
    if (in_stem) first_of_stem = std::min(first_of_stem, e.death);
    if (!in_stem) last_of_twigs = std::max(last_of_twigs, e.death);
  }
  EXPECT_LE(last_of_twigs, first_of_stem);
  EXPECT_EQ(s.counts[s.steps()], 0u);
}

TEST(TrunkRadii, WithoutAHierarchyThereIsFullDetailAlone) {
  Tree tree;
  tree.trunk.vertices = std::vector<Float3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  tree.trunk.triangles = std::vector<CornerTriangle>{{.vertex = {0, 1, 2}}};
  const Spectrum s = trunk_by_radii(tree);
  EXPECT_EQ(s.steps(), 0u);
  EXPECT_EQ(s.counts[0], 1u);
  EXPECT_EQ(trunk_by_radii(Tree{}).counts[0], 0u);
}

TEST(TrunkRadii, IsTheSameEveryTime) {
  const Tree tree = stem_with_twigs(8, 8, 20);
  const Spectrum a = trunk_by_radii(tree), b = trunk_by_radii(tree);
  EXPECT_EQ(a.elements.to_vector(), b.elements.to_vector());
  EXPECT_EQ(a.vertices.to_vector(), b.vertices.to_vector());
  EXPECT_EQ(a.triangles.to_vector(), b.triangles.to_vector());
}

}  // namespace
}  // namespace copse
