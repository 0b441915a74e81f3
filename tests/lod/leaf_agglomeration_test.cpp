#include "lib/analysis/lod/leaf_agglomeration.h"

#include "lib/analysis/lod/crown_field.h"
#include "lib/analysis/measure/lod_quality.h"
#include "tests/lod/leafy_tree.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace copse {
namespace {

Spectrum agglomerated(const Tree& tree) {
  const LeafPieces pieces = leaf_pieces(tree);
  return agglomerate_leaves(tree, {}, pieces, pieces.triangles.size());
}

std::uint32_t step_with(const Spectrum& s, std::size_t triangles) {
  std::uint32_t n = 0;
  while (n < s.steps() && s.counts[n] > triangles) ++n;
  return n;
}

TEST(LeafAgglomeration, RunsFromAllLeavesToOneInSmallSteps) {
  for (const bool alpha : {false, true}) {
    const Tree tree = LeafyTree{.alpha = alpha}.make();
    const Spectrum s = agglomerated(tree);
    EXPECT_EQ(s.method, LodMethod::collapse);
    EXPECT_EQ(s.counts[0], 400u);
    EXPECT_EQ(s.counts[s.steps()], alpha ? 2u : 1u);
    EXPECT_GT(s.steps(), alpha ? 100u : 200u);
    for (std::uint32_t n = 1; n <= s.steps(); ++n) {
      EXPECT_GE(s.errors[n], s.errors[n - 1]);
      EXPECT_LE(s.counts[n], s.counts[n - 1]);
    }
    for (const std::uint32_t n : {0u, 10u, s.steps() / 2, s.steps()})
      EXPECT_EQ(drawn_state(s, n).triangles.size(), s.counts[n]);
  }
}

TEST(LeafAgglomeration, StaysInTheHullAndNearTheOutline) {
  const Tree tree = LeafyTree{.leaves = 3000, .half = 0.12}.make();
  const Spectrum s = agglomerated(tree);
  const LodJudge judge(drawn_state(s, 0), {}, {.views = 12, .image_size = 64, .mask_size = 128});
  for (const double ratio : {0.5, 0.1}) {
    const LodQuality q = judge.measure(drawn_state(s, step_with(s, std::size_t(ratio * 6000))));
    if (ratio < 0.15) {
      EXPECT_NEAR(q.area_ratio, 1, 0.001) << ratio;
    }
    EXPECT_NEAR(q.coverage_ratio, 1, 0.12) << ratio;
    EXPECT_LE(q.hull_growth, 0.03) << ratio;
    EXPECT_GE(q.iou, 0.85) << ratio;
  }
}

TEST(LeafAgglomeration, WhatIsHiddenGoesFirst) {
  const Tree tree = LeafyTree{.leaves = 1500, .half = 0.4}.make();
  const Spectrum s = agglomerated(tree);
  double early = 0, late = 0;  // how far from the middle what goes is
  std::size_t first = 0, last = 0;
  for (std::size_t e = 0; e < s.elements.size(); ++e) {
    const SpectrumElement& element = s.elements[e];
    if (element.birth != 0) continue;
    const Double3 at = to_double(s.vertices[s.triangles[s.first_triangle[e]][0]].position);
    const std::uint32_t left = element.death == k_none ? 0 : s.counts[element.death];
    if (left >= 7 * s.counts[0] / 8) early += length(at), ++first;
    if (left < s.counts[0] / 2) late += length(at), ++last;
  }
  ASSERT_GT(first, 50u);
  ASSERT_GT(last, 50u);
  EXPECT_LT(early / double(first), 0.9 * late / double(last));
}

TEST(LeafAgglomeration, AFrondIsReplacedByACard) {
  Tree tree;
  std::vector<Float3> vertices;
  std::vector<CornerTriangle> triangles;
  for (int leaf = 0; leaf < 20; ++leaf)
    for (std::uint32_t i = 0; i < 6; ++i)
      vertices.push_back(
          {float(i / 2) + 3 * float(leaf % 5), float(i % 2) + float(leaf), 3 * float(leaf % 3)});
  for (std::uint32_t t = 0; t < 80; ++t) {
    CornerTriangle triangle;
    for (std::uint32_t c = 0; c < 3; ++c)
      triangle.vertex[c] = t / 4 * 6 + t % 4 + c, triangle.texcoord[c] = (t + c) % 4;
    triangles.push_back(triangle);
  }
  const LeafyTree maker{.groups = 2, .alpha = true};
  maker.finish(tree, vertices, triangles, std::vector<Float3>(20, Float3{1, 2, 1}));
  tree.header.leaf_factor = 4;
  const Spectrum s = agglomerated(tree);
  EXPECT_EQ(s.counts[0], 80u);
  EXPECT_EQ(s.counts[s.steps()], 2u);
  EXPECT_NEAR(area(drawn_state(s, s.steps() - 2)) / area(drawn_state(s, 0)), 1, 1e-3);
}

TEST(LeafAgglomeration, DegenerateLeavesGiveFiniteStates) {
  for (const double size : {0.0, 1e-20, 1e15}) {
    for (const std::uint32_t leaves : {1u, 2u, 30u}) {
      const Spectrum s = agglomerated(LeafyTree{.leaves = leaves, .half = size, .radius = size}.make());
      EXPECT_EQ(s.counts[s.steps()], 1u);
      for (const SpectrumVertex& v : s.vertices) EXPECT_TRUE(is_finite(v.position)) << size;
      for (const float e : s.errors) EXPECT_LE(e, 4e15f) << size;
    }
  }
  EXPECT_TRUE(agglomerated(Tree{}).elements.empty());
}

TEST(LeafAgglomeration, GivesTheSameTwice) {
  const Tree tree = LeafyTree{.leaves = 500}.make();
  const Spectrum a = agglomerated(tree), b = agglomerated(tree);
  EXPECT_TRUE(std::equal(a.vertices.begin(), a.vertices.end(), b.vertices.begin(), b.vertices.end()));
  EXPECT_TRUE(std::equal(a.elements.begin(), a.elements.end(), b.elements.begin(), b.elements.end()));
}

TEST(LeafAgglomeration, ClosedFormsEndWhenTheyAreToldTo) {
  const Tree tree = LeafyTree{.leaves = 600, .half = 0.05}.make();
  const LeafPieces pieces = leaf_pieces(tree);
  std::vector<FoliageTriangle> triangles(pieces.part.triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c)
      triangles[t].corners[c] = to_double(pieces.part.vertices[pieces.part.triangles[t][c]].position);
  const CrownField field(triangles, 16);
  const RadiusAncestors ancestors(tree);
  const auto left = [&](const std::vector<bool>& answers) {
    LeafElements elements(pieces);
    std::vector<std::size_t> asked;
    const auto good = [&](std::span<const QuickMerges::Leaf> leaves) {
      asked.push_back(leaves.size());
      return asked.size() > answers.size() || answers[asked.size() - 1];
    };
    const QuickMerges merges = merge_quickly(pieces, field, ancestors, elements, 100, good);
    std::size_t before = elements.size();
    for (const std::size_t n : asked) {
      EXPECT_LE(double(n), 0.75 * double(before)) << "asked each time a fourth has gone";
      before = n;
    }
    for (const std::uint32_t host : merges.host)
      EXPECT_TRUE(std::ranges::any_of(merges.leaves, [&](const auto& l) { return l.node == host; }));
    if (asked.size() == answers.size() && !answers.empty()) {
      EXPECT_EQ(merges.leaves.size(), asked.back());
    }
    return merges.leaves.size();
  };
  EXPECT_LE(left({}), 100u);
  const std::size_t at_once = left({false}), later = left({true, false});
  EXPECT_GT(at_once, 600u);
  EXPECT_GT(at_once, later);
  EXPECT_GT(later, 100u);
}

}  // namespace
}  // namespace copse
