#include "lib/analysis/lod/floating_leaves.h"

#include "lib/analysis/lod/spectrum_builder.h"
#include "lib/analysis/lod/trunk_radii.h"
#include "tests/lod/tube_tree.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace copse {
namespace {

// A leaf at the tip of every twig, and one big leaf on the stem that takes their place in the end.
LodSpectra with_leaves(const Tree& tree, double size) {
  LodSpectra s;
  s.trunk = trunk_by_radii(tree);
  SpectrumBuilder b(LodMethod::collapse);
  const std::vector<Double3> centres = absolute_centres(tree);
  const auto leaf = [&](std::uint32_t r, double half) {
    std::array<std::uint32_t, 3> v{};
    for (std::size_t c = 0; c < 3; ++c)
      v[c] = b.vertex({to_float(centres[r] + Double3{c == 0   ? half
                                                     : c == 1 ? -half
                                                              : 0.0,
                                                     c == 2 ? half : 0.0, 0}),
                       {},
                       {}});
    return b.element(k_none, r, std::span(&v, 1));
  };
  std::vector<std::uint32_t> leaves;
  for (std::uint32_t r = 0; r < tree.radius_count(); ++r)
    if (tree.hierarchy.radii[r].flags & Radius::terminal && !(tree.hierarchy.radii[r].flags & Radius::joint))
      leaves.push_back(leaf(r, size));
  b.step(1);
  for (const std::uint32_t l : leaves) b.remove(l);
  leaf(0, size);
  s.leaves = b.finish();
  return s;
}

TEST(FloatingLeaves, NoneAtFullDetail) {
  Tree tree = stem_with_twigs(6, 8, 5);
  EXPECT_EQ(FloatingLeaves(tree, with_leaves(tree, 0.05)).count({}), 0u);
}

TEST(FloatingLeaves, SmallLeavesFloatWhenTheirTwigsAreGone) {
  Tree tree = stem_with_twigs(6, 8, 5);
  const LodSpectra s = with_leaves(tree, 0.02);
  const FloatingLeaves floating(tree, s);
  // The step at which the twigs are gone and the stem is not: the last one before nothing is left.
  LodLevel level{.trunk_steps = s.trunk.steps() - 1};
  EXPECT_GE(floating.count(level), 5u);
  // What took their place hangs on the stem.
  level.leaf_steps = 1;
  EXPECT_EQ(floating.count(level), 0u);
}

TEST(FloatingLeaves, ALeafThatReachesTheStemDoesNotFloat) {
  Tree tree = stem_with_twigs(6, 8, 4);  // none above the stem
  const LodSpectra s = with_leaves(tree, 2.0);
  EXPECT_EQ(FloatingLeaves(tree, s).count({.trunk_steps = s.trunk.steps() - 1}), 0u);
}

// Every leaf alone: does it float at so many steps of the trunk?
std::vector<std::vector<bool>> each_alone(const Tree& tree, const LodSpectra& s) {
  std::vector<std::vector<bool>> out;
  for (std::size_t e = 0; e < s.leaves.elements.size(); ++e) {
    LodSpectra one = s;
    std::vector<SpectrumElement> elements = s.leaves.elements.to_vector();
    for (std::size_t other = 0; other < elements.size(); ++other)
      elements[other].birth = other == e ? 0 : k_none, elements[other].death = k_none;
    one.leaves.elements = elements;
    const FloatingLeaves floating(tree, one);
    out.emplace_back();
    for (std::uint32_t steps = 0; steps <= s.trunk.steps(); ++steps)
      out.back().push_back(floating.count({.trunk_steps = steps}) > 0);
  }
  return out;
}

TEST(FloatingLeaves, FloatsByIsWhetherItHasEverFloatedInWhateverOrderOneAsks) {
  Tree tree = stem_with_twigs(6, 8, 5);
  for (const double size : {0.02, 0.2, 0.6}) {
    const LodSpectra s = with_leaves(tree, size);
    const auto floats = each_alone(tree, s);
    const auto last = static_cast<std::int64_t>(s.trunk.steps());
    for (const std::int64_t stride : {1, -1, 7, -5}) {
      FloatingLeaves floating(tree, s);
      std::size_t ever = 0;
      for (std::uint32_t e = 0; e < floats.size(); ++e) {
        for (std::int64_t i = 0; i <= last; ++i) {
          const auto steps = static_cast<std::size_t>(((i * stride) % (last + 1) + last + 1) % (last + 1));
          const bool by = std::find(floats[e].begin(), floats[e].begin() + std::int64_t(steps) + 1, true) !=
                          floats[e].begin() + std::int64_t(steps) + 1;
          ASSERT_EQ(floating.floats_by(e, static_cast<std::uint32_t>(steps)), by) << e << " at " << steps;
          ever += by;
        }
      }
      EXPECT_GT(ever, 0u) << "the trunk goes altogether";
    }
  }
}

TEST(FloatingLeaves, OnlyStepsAfterThoseThatMoveEverythingAreBlamed) {
  Tree tree = stem_with_twigs(6, 8, 5);
  const LodSpectra s = with_leaves(tree, 0.02);
  const std::vector<std::vector<bool>> floats = each_alone(tree, s);
  std::size_t excused = 0, blamed = 0;
  for (std::uint32_t from = 1; from < s.trunk.steps(); ++from) {
    FloatingLeaves floating(tree, s, from);
    for (std::uint32_t e = 0; e < floats.size(); ++e) {
      bool by = false;
      for (std::uint32_t steps = 0; steps <= s.trunk.steps(); ++steps) {
        by = by || (steps > from && !floats[e][from] && floats[e][steps]);
        EXPECT_EQ(floating.floats_by(e, steps), by) << e << " after " << steps << " of " << from;
      }
      excused += floats[e][from], blamed += by;
    }
  }
  EXPECT_GT(excused, 0u);
  EXPECT_GT(blamed, 0u);
}

TEST(FloatingLeaves, NothingFloatsByFullDetailHoweverFarItIs) {
  Tree tree = stem_with_twigs(6, 8, 5);
  LodSpectra s = with_leaves(tree, 0.02);
  std::vector<SpectrumVertex> vertices = s.leaves.vertices.to_vector();
  for (SpectrumVertex& v : vertices) v.position = v.position + Float3{40, 3, 0};
  s.leaves.vertices = vertices;
  FloatingLeaves floating(tree, s);
  for (std::uint32_t e = 0; e < s.leaves.elements.size(); ++e) EXPECT_FALSE(floating.floats_by(e, 0));
  EXPECT_TRUE(floating.floats_by(0, s.trunk.steps())) << "but without any trunk";
}

TEST(FloatingLeaves, OneWideGapInAGroupExcusesNoOtherLeaf) {
  Tree tree = stem_with_twigs(6, 8, 5);
  LodSpectra s = with_leaves(tree, 0.02);
  const std::uint64_t before = FloatingLeaves(tree, s).count({.trunk_steps = s.trunk.steps() - 1});
  // One more leaf at the first twig, that was far from everything at full detail: it may float on.
  SpectrumBuilder b(LodMethod::collapse);
  for (const SpectrumVertex& v : s.leaves.vertices) b.vertex(v);
  const std::uint32_t r = s.leaves.elements[0].radius;
  b.step(1);
  for (std::size_t e = 0; e < s.leaves.elements.size(); ++e)
    b.element(s.leaves.elements[e], std::span(s.leaves.triangles)
                                        .subspan(s.leaves.first_triangle[e], s.leaves.first_triangle[e + 1] -
                                                                                 s.leaves.first_triangle[e]));
  std::array<std::uint32_t, 3> far{};
  for (std::uint32_t& v : far) v = b.vertex({{9, 9, 9}, {}, {}});
  b.element({.birth = 0, .death = k_none, .material = k_none, .radius = r}, std::span(&far, 1));
  s.leaves = b.finish();
  EXPECT_EQ(FloatingLeaves(tree, s).count({.trunk_steps = s.trunk.steps() - 1}), before);
}

TEST(FloatingLeaves, WithoutATrunkNothingFloats) {
  EXPECT_EQ(FloatingLeaves(Tree{}, LodSpectra{}).count({}), 0u);
  EXPECT_FALSE(FloatingLeaves(Tree{}, LodSpectra{}).floats_by(0, 5));
}

}  // namespace
}  // namespace copse
