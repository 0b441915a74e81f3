#include "lib/analysis/lod/coupling.h"

#include "lib/analysis/lod/spectrum_builder.h"

#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

// A spectrum that loses one triangle a step.
Spectrum countdown(std::uint32_t triangles) {
  SpectrumBuilder b(LodMethod::radii);
  std::vector<std::uint32_t> elements;
  for (std::uint32_t t = 0; t < triangles; ++t) {
    const std::uint32_t v = b.vertex({});
    const std::array<std::uint32_t, 3> corners{v, v, v};
    elements.push_back(b.element(k_none, k_none, std::span(&corners, 1)));
  }
  for (std::uint32_t t = 0; t < triangles; ++t) {
    b.step(0.001 * (t + 1));
    b.remove(elements[t]);
  }
  return b.finish();
}

LodSpectra two_parts(std::uint32_t trunk, std::uint32_t leaves) {
  LodSpectra s;
  s.trunk = countdown(trunk), s.leaves = countdown(leaves);
  return s;
}

void expect_schedule(const LodSpectra& s, const std::vector<LodLevel>& knots) {
  ASSERT_FALSE(knots.empty());
  EXPECT_EQ(knots.front(), level_at(s, 0, 0));
  for (std::size_t i = 1; i < knots.size(); ++i) {
    EXPECT_GE(knots[i].trunk_steps, knots[i - 1].trunk_steps);
    EXPECT_GE(knots[i].leaf_steps, knots[i - 1].leaf_steps);
    EXPECT_LT(knots[i].triangles, knots[i - 1].triangles);
    EXPECT_GE(knots[i].error, knots[i - 1].error);
  }
}

TEST(Coupling, GoesFromFullDetailToTheCoarsestState) {
  const LodSpectra s = two_parts(400, 900);
  const auto knots = couple(s, nullptr, nullptr);
  expect_schedule(s, knots);
  EXPECT_EQ(knots.back().triangles, 0u);
}

TEST(Coupling, WithoutAPictureBothKeepTheSameShare) {
  const LodSpectra s = two_parts(1000, 3000);
  for (const LodLevel& knot : couple(s, nullptr, nullptr)) {
    const double trunk = s.trunk.counts[knot.trunk_steps] / 1000.0,
                 leaves = s.leaves.counts[knot.leaf_steps] / 3000.0;
    EXPECT_NEAR(trunk, leaves, 0.01);
  }
}

TEST(Coupling, TakesFromThePartThatThePictureMissesLess) {
  const LodSpectra s = two_parts(1000, 1000);
  // The picture wants the trunk: whatever it loses counts a hundred times.
  const auto error = [&](const LodLevel& l) { return 100.0 * l.trunk_steps + l.leaf_steps; };
  const auto knots = couple(s, error, nullptr);
  expect_schedule(s, knots);
  const auto half =
      std::find_if(knots.begin(), knots.end(), [](const LodLevel& l) { return l.triangles <= 1200; });
  ASSERT_NE(half, knots.end());
  EXPECT_EQ(s.trunk.counts[half->trunk_steps], 1000u);
}

TEST(Coupling, TakesNothingThatLeavesLeavesInTheAir) {
  const LodSpectra s = two_parts(1000, 1000);
  // Leaves float as soon as the trunk has lost more steps than the leaves; the picture would rather lose the
  // trunk.
  const auto error = [](const LodLevel& l) { return static_cast<double>(l.leaf_steps); };
  const auto floats = [](const LodLevel& l) { return std::uint64_t{l.trunk_steps > l.leaf_steps}; };
  for (const LodLevel& knot : couple(s, error, floats)) EXPECT_LE(knot.trunk_steps, knot.leaf_steps);
}

TEST(Coupling, StopsAtTheLeastNumberOfTriangles) {
  const LodSpectra s = two_parts(400, 900);
  EXPECT_GE(couple(s, nullptr, nullptr, {.min_triangles = 200}).back().triangles, 200u);
}

TEST(Coupling, OnePartAloneHasAScheduleToo) {
  LodSpectra s;
  s.leaves = countdown(100);
  const auto knots = couple(s, nullptr, nullptr);
  expect_schedule(s, knots);
  EXPECT_EQ(knots.back().triangles, 0u);
  EXPECT_EQ(couple({}, nullptr, nullptr).size(), 1u);
}

TEST(Coupling, FindsTheFirstStepWithSoManyTriangles) {
  const Spectrum s = countdown(10);
  EXPECT_EQ(step_with(s, 10), 0u);
  EXPECT_EQ(step_with(s, 7), 3u);
  EXPECT_EQ(step_with(s, 0), 10u);
}

}  // namespace
}  // namespace copse
