#include "lib/analysis/lod/leaf_collapse.h"

#include "lib/analysis/measure/lod_quality.h"
#include "tests/lod/leafy_tree.h"

#include <algorithm>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace copse {
namespace {

std::uint32_t step_with(const Spectrum& s, std::size_t triangles) {
  std::uint32_t n = 0;
  while (n < s.steps() && s.counts[n] > triangles) ++n;
  return n;
}

TEST(LeafCollapse, RunsFromAllLeavesToOne) {
  const Spectrum s = collapse_spectrum(LeafyTree{}.make());
  EXPECT_EQ(s.method, LodMethod::collapse);
  EXPECT_EQ(s.counts[0], 400u);
  EXPECT_EQ(s.counts[s.steps()], 1u);
  EXPECT_GT(s.steps(), 100u) << "a few triangles less a step";
}

TEST(LeafCollapse, WhereNoTriangleHoldsBothHalvesOfASquareOneHalfStays) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const Spectrum s = collapse_spectrum(LeafyTree{.leaves = 1, .groups = 1, .seed = seed}.make());
    ASSERT_EQ(s.counts[s.steps()], 1u);
    EXPECT_GE(area(drawn_state(s, s.steps())) / area(drawn_state(s, 0)), 0.499);
  }
}

TEST(LeafCollapse, BeginsWithTheTreesOwnLeaves) {
  const Tree tree = LeafyTree{}.make();
  const DrawnMesh full = drawn_leaves(tree), state = drawn_state(collapse_spectrum(tree), 0);
  EXPECT_EQ(state.triangles.size(), full.triangles.size());
  EXPECT_NEAR(area(state), area(full), 1e-9 * area(full));
}

TEST(LeafCollapse, CountsAreWhatIsDrawnAtEveryStep) {
  for (const bool alpha : {false, true}) {
    const Spectrum s = collapse_spectrum(LeafyTree{.leaves = 60, .alpha = alpha}.make());
    for (std::uint32_t n = 0; n <= s.steps(); ++n) EXPECT_EQ(drawn_state(s, n).triangles.size(), s.counts[n]);
  }
}

TEST(LeafCollapse, KeepsTheSumOfAreasOnceMergedLeavesAreShownWhileItFits) {
  for (const CollapseQuality quality : {CollapseQuality::fast, CollapseQuality::balanced}) {
    for (const bool alpha : {false, true}) {
      const Spectrum s =
          collapse_spectrum(LeafyTree{.leaves = 300, .alpha = alpha}.make(), {}, {.quality = quality});
      const double full = area(drawn_state(s, 0));
      for (std::uint32_t n = 0; n <= s.steps() && s.counts[n] >= 16; ++n) {
        const double ratio = area(drawn_state(s, n)) / full;
        EXPECT_LE(ratio, 1.05) << n << ": some leaves have grown before those that they grow for leave";
        if (s.counts[n] <= 0.14 * 600) {
          EXPECT_NEAR(ratio, 1, 1e-4) << n;
        }
      }
    }
  }
}

// What leaves before that was hidden.
TEST(LeafCollapse, HoldsCoverageWhereItLetsAreaGo) {
  const Tree tree = LeafyTree{.leaves = 1500, .half = 0.25}.make();
  for (const CollapseQuality quality : {CollapseQuality::fast, CollapseQuality::balanced}) {
    const Spectrum s = collapse_spectrum(tree, {}, {.quality = quality});
    const LodJudge judge(drawn_state(s, 0), {}, {.views = 42, .image_size = 64, .mask_size = 128});
    for (const double ratio : {0.8, 0.5, 0.25}) {
      const LodQuality q = judge.measure(drawn_state(s, step_with(s, std::size_t(ratio * 3000))));
      EXPECT_NEAR(q.coverage_ratio, 1, quality == CollapseQuality::fast ? 0.03 : 0.02) << ratio;
      EXPECT_LE(q.area_ratio, 1.001) << ratio;
    }
  }
}

TEST(LeafCollapse, ErrorsAndCountsAreMonotone) {
  const Spectrum s = collapse_spectrum(LeafyTree{}.make());
  for (std::uint32_t n = 1; n <= s.steps(); ++n) {
    EXPECT_GE(s.errors[n], s.errors[n - 1]);
    EXPECT_LE(s.counts[n], s.counts[n - 1]);
  }
}

TEST(LeafCollapse, HoldsAreaAndCoverageTogether) {
  const Tree tree = LeafyTree{.leaves = 3000, .half = 0.12}.make();
  const Spectrum s = collapse_spectrum(tree);
  const LodJudge judge(drawn_state(s, 0), {}, {.views = 12, .image_size = 64, .mask_size = 128});
  for (const double ratio : {0.25, 0.1, 0.02}) {
    const LodQuality q = judge.measure(drawn_state(s, step_with(s, std::size_t(ratio * 6000))));
    EXPECT_NEAR(q.area_ratio, 1, 0.02) << ratio;
    EXPECT_NEAR(q.coverage_ratio, 1, ratio < 0.1 ? 0.15 : 0.05) << ratio;
    EXPECT_LE(q.hull_growth, 0.03) << ratio;
    EXPECT_GE(q.iou, 0.8) << ratio;
  }
}

// A ball of leaves round a core of leaves.
TEST(LeafCollapse, WhatNoOneSeesGoesFirstAndTheOutlineStays) {
  const Tree tree = LeafyTree{.leaves = 1500, .half = 0.4}.make();
  for (const CollapseQuality quality : {CollapseQuality::balanced, CollapseQuality::exact}) {
    const Spectrum s = collapse_spectrum(tree, {}, {.quality = quality});
    const LodJudge judge(drawn_state(s, 0), {}, {.views = 42, .image_size = 64, .mask_size = 128});
    const LodQuality q = judge.measure(drawn_state(s, step_with(s, 1500)));
    EXPECT_LT(q.area_ratio, 0.9);
    EXPECT_GE(q.iou, 0.99);
    EXPECT_LE(q.hull_growth, 0.001) << "nothing has grown";
  }
}

TEST(LeafCollapse, SeesTheGroundThroughAlpha) {
  const Tree tree = LeafyTree{.leaves = 400, .alpha = true}.make();
  const std::vector<AlphaMask> masks{{4, 1, {0, 1, 0, 0}}};
  const Looks looks{tree.materials, masks};
  const Spectrum s = collapse_spectrum(tree, looks);
  const LodJudge judge(drawn_state(s, 0), looks, {.views = 12, .image_size = 64, .mask_size = 128});
  EXPECT_NEAR(judge.measure(drawn_state(s, step_with(s, 200))).coverage_ratio, 1, 0.05);
}

TEST(LeafCollapse, CardsStayWholePicturesOfOneMaterial) {
  const Spectrum s = collapse_spectrum(LeafyTree{.leaves = 50, .alpha = true}.make());
  EXPECT_EQ(s.counts[s.steps()], 2u);
  const DrawnMesh last = drawn_state(s, s.steps());
  ASSERT_EQ(last.positions.size(), 4u);
  FloatBox uv;
  for (const Float2& t : last.texcoords) uv.grow(Float3{t.x, t.y, 0});
  EXPECT_EQ(uv.min, (Float3{0, 0, 0}));
  EXPECT_EQ(uv.max, (Float3{1, 1, 0}));
  EXPECT_EQ(last.material, (std::vector<std::uint32_t>{0, 0}));
}

TEST(LeafCollapse, DoesNotDependOnTheNumberOfThreads) {
  const Tree tree = LeafyTree{.leaves = 500}.make();
  const Spectrum many = collapse_spectrum(tree);
  tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Spectrum single = collapse_spectrum(tree);
  EXPECT_TRUE(
      std::equal(many.vertices.begin(), many.vertices.end(), single.vertices.begin(), single.vertices.end()));
  EXPECT_TRUE(
      std::equal(many.elements.begin(), many.elements.end(), single.elements.begin(), single.elements.end()));
  EXPECT_TRUE(std::equal(many.errors.begin(), many.errors.end(), single.errors.begin(), single.errors.end()));
}

TEST(LeafCollapse, OfNoLeavesIsEmpty) {
  const Spectrum s = collapse_spectrum(Tree{});
  EXPECT_EQ(s.steps(), 0u);
  EXPECT_TRUE(s.elements.empty());
}

TEST(LeafCollapse, DegenerateLeavesGiveFiniteStates) {
  for (const double size : {0.0, 1e-20, 1e15}) {
    for (const std::uint32_t leaves : {1u, 2u, 30u}) {
      const Spectrum s = collapse_spectrum(LeafyTree{.leaves = leaves, .half = size, .radius = size}.make());
      EXPECT_EQ(s.counts[s.steps()], 1u);
      for (const SpectrumVertex& v : s.vertices) EXPECT_TRUE(is_finite(v.position)) << size;
      for (const float e : s.errors) EXPECT_LE(e, 4e15f) << size;
    }
  }
}

}  // namespace
}  // namespace copse
