#include "lib/analysis/skeleton/limb_samples.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

LimbSample at(double way, double x, double radius, bool measured = true, bool fork = false) {
  return {{{x, way, 0}, radius}, way, 0, fork, measured};
}

TEST(LimbSamples, ThatTheirNeighboursImplyAreLeftOut) {
  std::vector<LimbSample> straight;
  for (int i = 0; i <= 10; ++i) straight.push_back(at(i, 0, 1 - 0.05 * i));
  EXPECT_EQ(thin_out(straight).size(), 2u);
  straight[4].fork = true;
  EXPECT_EQ(thin_out(straight).size(), 3u);
}

TEST(LimbSamples, AtABendStay) {
  std::vector<LimbSample> bent;
  for (int i = 0; i <= 10; ++i) bent.push_back(at(i, i < 5 ? 0 : i - 5, 1));
  const auto kept = thin_out(bent);
  ASSERT_EQ(kept.size(), 3u);
  EXPECT_EQ(kept[1].way, 5);
}

TEST(LimbSamples, OfAStraightLimbAreNotTooFarApart) {
  std::vector<LimbSample> thin;
  for (int i = 0; i <= 100; ++i) thin.push_back(at(i, 0, 0.5));
  const auto kept = thin_out(thin);
  EXPECT_GT(kept.size(), 8u);
  EXPECT_LT(kept.size(), 20u);
}

TEST(LimbSamples, WithoutThicknessAreFew) {
  std::vector<LimbSample> flat;
  for (int i = 0; i <= 1000; ++i) flat.push_back(at(i, 0, 0));
  EXPECT_LT(thin_out(flat).size(), 300u);
  EXPECT_EQ(thin_out(std::vector<LimbSample>{at(0, 0, 0)}).size(), 1u);
}

TEST(BridgeGaps, InterpolatesWhatWasNotMeasured) {
  std::vector<LimbSample> s{at(0, 0, 1), at(1, 9, 7, false), at(2, 0, 0.8)};
  bridge_gaps(s, {});
  EXPECT_NEAR(s[1].circle.radius, 0.9, 1e-12);
  EXPECT_NEAR(s[1].circle.centre.x, 0, 1e-12);
}

TEST(BridgeGaps, TakesTheOtherLimbOutOfAFork) {
  std::vector<LimbSample> s;
  for (int i = 0; i < 9; ++i) s.push_back(at(i, 0, 1));
  for (int i = 3; i < 6; ++i) s[static_cast<std::size_t>(i)] = at(i, 0.8, 1.7);
  const LimbFork fork{4, 2.5, 5.5};
  bridge_gaps(s, std::span(&fork, 1));
  for (const LimbSample& c : s) {
    EXPECT_NEAR(c.circle.radius, 1, 1e-12);
    EXPECT_NEAR(c.circle.centre.x, 0, 1e-12);
  }
}

TEST(LimbProfile, DoesNotBelieveATornSlice) {
  CurveSkeleton k;
  Limb limb;
  for (int i = 0; i < 9; ++i) {
    k.points.push_back({0, 0.2 * i, 0});
    k.radii.push_back(i == 4 ? 0.01 : 1);
    limb.nodes.push_back(static_cast<std::uint32_t>(i));
  }
  const LimbProfile p = limb_profile(k, limb);
  EXPECT_NEAR(p.way.back(), 1.6, 1e-12);
  EXPECT_GT(p.thickness[4], 0.85);
}

}  // namespace
}  // namespace copse
