#include "lib/analysis/volumes/choose.h"

#include <vector>

#include <gtest/gtest.h>

namespace copse {
namespace {

std::size_t chosen(const std::vector<Candidate>& c, Criterion criterion, const ExpectedCost& expected = {}) {
  return choose(c, criterion, table_costs(), expected, 1);
}

TEST(Choose, TheCostsAreThoseOfTheTableWithItsErrata) {
  const TestCosts c = table_costs();
  const auto of = [&](VolumeKind kind) { return c.relative[static_cast<std::size_t>(kind)]; };
  EXPECT_DOUBLE_EQ(of(VolumeKind::sphere), 1);
  EXPECT_NEAR(of(VolumeKind::capsule), 2, 1e-3);
  EXPECT_NEAR(of(VolumeKind::cylinder), 3.159, 1e-3);  // printed 2.949, with two multiplications too few
  EXPECT_NEAR(of(VolumeKind::lozenge), 4, 1e-3);
  EXPECT_NEAR(of(VolumeKind::obb), 4.239, 1e-3);
  EXPECT_NEAR(of(VolumeKind::ellipsoid), 4.239, 1e-3);
  EXPECT_LT(of(VolumeKind::aabb), of(VolumeKind::obb));
  EXPECT_GT(c.of({VolumeKind::kdop, {}, 13}), c.of({VolumeKind::kdop, {}, 7}));
}

TEST(Choose, TheLeastVolumeWins) {
  EXPECT_EQ(
      chosen(
          {{VolumeKind::sphere, {3, 1, 1}}, {VolumeKind::obb, {2, 1, 1}}, {VolumeKind::lozenge, {2.1, 1, 1}}},
          Criterion::volume),
      1u);
}

TEST(Choose, TiesGoToTheCheaperTest) {
  const std::vector<Candidate> same{{VolumeKind::lozenge, {2, 1, 1}},
                                    {VolumeKind::capsule, {2 * (1 + 1e-8), 1, 1}},
                                    {VolumeKind::sphere, {2.1, 1, 1}}};
  EXPECT_EQ(chosen(same, Criterion::volume), 1u);
}

TEST(Choose, WhatIsFlatButForRoundingHasNoVolume) {
  EXPECT_EQ(chosen({{VolumeKind::obb, {1e-7, 1, 1}},
                    {VolumeKind::lozenge, {3e-7, 1, 1}},
                    {VolumeKind::sphere, {4, 1, 1}}},
                   Criterion::volume),
            1u);
}

TEST(Choose, WhatIsThinButNotFlatIsChosenByItsVolume) {
  // A lath 1 long and 5e-5 thick.
  EXPECT_EQ(chosen({{VolumeKind::obb, {2.5e-9, 2e-4, 0.5}}, {VolumeKind::capsule, {2e-7, 1.6e-3, 0.5}}},
                   Criterion::volume),
            0u);
}

TEST(Choose, WeightsMakeACheapTestWinOverASmallGain) {
  const std::vector<Candidate> c{{VolumeKind::sphere, {3, 1, 1}}, {VolumeKind::lozenge, {2, 1, 1}}};
  EXPECT_EQ(chosen(c, Criterion::volume), 1u);
  EXPECT_EQ(chosen(c, Criterion::weighted), 0u);
}

TEST(Choose, TheExpectedCostTurnsWithWhatTheContentCosts) {
  const std::vector<Candidate> c{{VolumeKind::sphere, {3, 10, 2}}, {VolumeKind::obb, {2, 8, 1.8}}};
  EXPECT_EQ(chosen(c, Criterion::expected, {.content = 1, .rays = 0.5}), 0u);
  EXPECT_EQ(chosen(c, Criterion::expected, {.content = 1000, .rays = 0.5}), 1u);
}

TEST(Choose, RaysGoBySurfaceAndPlanesByMeanWidth) {
  const std::vector<Candidate> c{{VolumeKind::capsule, {1, 10, 3}}, {VolumeKind::cylinder, {1, 12, 2}}};
  EXPECT_EQ(chosen(c, Criterion::expected, {.content = 1000, .rays = 1}), 0u);
  EXPECT_EQ(chosen(c, Criterion::expected, {.content = 1000, .rays = 0}), 1u);
}

// A segment 1 long: rays miss it and its flat volumes, not its ball.
TEST(Choose, WhatHasNoSurfaceLosesToNothingThatHasOne) {
  const std::vector<Candidate> c{{VolumeKind::sphere, {0.52, 3.1, 1}},
                                 {VolumeKind::capsule, {0, 0, 0.5}},
                                 {VolumeKind::obb, {0, 0, 0.5}}};
  EXPECT_EQ(chosen(c, Criterion::expected, {.content = 50, .rays = 1}), 1u);
  EXPECT_EQ(chosen(c, Criterion::expected, {.content = 1, .rays = 0.01}), 1u);
  EXPECT_EQ(chosen(c, Criterion::expected, {.content = 0, .rays = 1}), 0u);    // nothing is lost by any hit
  EXPECT_EQ(chosen(c, Criterion::expected, {.content = 0.1, .rays = 0}), 0u);  // nor are there rays
  const std::vector<Candidate> point{{VolumeKind::sphere, {0.52, 3.1, 1}}, {VolumeKind::capsule, {0, 0, 0}}};
  EXPECT_EQ(chosen(point, Criterion::expected, {.content = 1, .rays = 0}), 1u);
}

TEST(Choose, PointsChooseTheCheapest) {
  EXPECT_EQ(choose(std::vector<Candidate>{{VolumeKind::obb, {}}, {VolumeKind::sphere, {}}}, Criterion::volume,
                   table_costs(), {}, 0),
            1u);
}

}  // namespace
}  // namespace copse
