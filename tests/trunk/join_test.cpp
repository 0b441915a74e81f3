#include "lib/analysis/trunk/join.h"

#include "lib/analysis/rings/taper.h"
#include "tests/trunk/limb_maker.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(Join, MergesRingsInOnePlaceAndMakesTheirLimbsOne) {
  Limbs limbs;
  add_limb(limbs, {0, 0, 0}, {0, 1, 0}, {1, 0.9, 0.8});
  add_limb(limbs, {0, 2, 0}, {0, 1, 0}, {0.8, 0.7, 0.6, 0.5});
  LimbSegments segments(limbs);
  join(limbs, segments);
  EXPECT_EQ(limbs.limb[0], limbs.limb[6]);
  EXPECT_EQ(end_rings(limbs).size(), 2u);
  int merged = 0;
  for (const std::uint32_t m : limbs.merged_into) merged += m != k_none;
  EXPECT_EQ(merged, 1);
}

TEST(Join, KeepsTheSameOfTwoRingsWhicheverTheFileHasFirst) {
  for (const bool swapped : {false, true}) {
    Limbs limbs;
    const auto lower = [&] { add_limb(limbs, {0, 0, 0}, {0, 1, 0}, {1, 0.9, 0.8}); };
    const auto upper = [&] { add_limb(limbs, {1e-4, 2, 0}, {0, 1, 0}, {0.80005, 0.7, 0.6}); };
    swapped ? upper() : lower();
    swapped ? lower() : upper();
    LimbSegments segments(limbs);
    join(limbs, segments);
    const std::uint32_t joint = limbs.alive(swapped ? 0 : 2);
    EXPECT_EQ(limbs.centre[joint].x, 0);
    EXPECT_EQ(limbs.diameter[joint], 0.8);
  }
}

TEST(Join, LeavesSiblingsApartThatBeginInOnePlace) {
  Limbs limbs;
  add_limb(limbs, {0, 0, 0}, {0, 1, 0}, {1, 0.5, 0.2});
  add_limb(limbs, {0, 0, 0}, {1, 0, 0}, {1, 0.5, 0.2});
  LimbSegments segments(limbs);
  join(limbs, segments);
  EXPECT_NE(limbs.limb[0], limbs.limb[3]);
}

TEST(Join, LeavesTwigsOfOneThicknessApartThatBeginInOnePlace) {
  for (const double degrees : {5, 30, 85}) {
    const double a = degrees * std::numbers::pi / 180;
    Limbs limbs;
    add_limb(limbs, {0, 0, 0}, {0, 1, 0}, {1, 1, 1});
    add_limb(limbs, {0, 0, 0}, {std::sin(a), std::cos(a), 0}, {1, 1, 1});
    LimbSegments segments(limbs);
    join(limbs, segments);
    EXPECT_NE(limbs.limb[0], limbs.limb[3]) << degrees;
  }
}

TEST(Join, LeavesOppositeTwigsApartThatBeginOnABoughsAxis) {
  for (const double degrees : {100, 140, 180}) {
    const double a = degrees / 2 * std::numbers::pi / 180;
    Limbs limbs;
    add_limb(limbs, {-3, 0, 0}, {1, 0, 0}, {0.5, 0.4, 0.4, 0.3, 0.3, 0.2, 0.2});
    add_limb(limbs, {0.5, 0, 0}, {0, std::cos(a), std::sin(a)}, {0.1, 0.1, 0.1});
    add_limb(limbs, {0.5, 0, 0}, {0, std::cos(a), -std::sin(a)}, {0.1, 0.1, 0.1});
    LimbSegments segments(limbs);
    join(limbs, segments);
    EXPECT_NE(limbs.limb[7], limbs.limb[10]) << degrees;
    EXPECT_NE(limbs.limb[0], limbs.limb[7]) << degrees;
  }
}

TEST(Join, LeavesRingsApartThatDifferInPlaceOrThickness) {
  Limbs limbs;
  add_limb(limbs, {0, 0, 0}, {0, 1, 0}, {1, 1, 1});
  add_limb(limbs, {0, 2.01, 0}, {0, 1, 0}, {1, 1, 1});
  add_limb(limbs, {0, 0, 0}, {0, -1, 0}, {0.9, 0.9});
  LimbSegments segments(limbs);
  join(limbs, segments);
  EXPECT_NE(limbs.limb[0], limbs.limb[3]);
  EXPECT_NE(limbs.limb[0], limbs.limb[6]);
}

TEST(Join, MergesFacingRingsOfOneThicknessThatARoughFileMovedALittle) {
  struct Case {
    Double3 from, step;
    double diameter;
    bool is_one;
  };
  for (const Case& c :
       {Case{{0.02, 2.005, 0}, {0, 1, 0}, 1, true}, Case{{0.05, 2, 0}, {0, 1, 0}, 1, false},
        Case{{0.02, 2.005, 0}, {0, -1, 0}, 1, false}, Case{{0.02, 2.005, 0}, {0, 1, 0}, 0.98, false}}) {
    Limbs limbs;
    add_limb(limbs, {0, 0, 0}, {0, 1, 0}, {1, 1, 1});
    add_limb(limbs, c.from, c.step, {c.diameter, c.diameter, c.diameter});
    for (Double3& n : limbs.normal) n = {0, 1, 0};
    LimbSegments segments(limbs);
    join(limbs, segments);
    EXPECT_EQ(limbs.limb[0] == limbs.limb[3], c.is_one) << c.from.x << ' ' << c.step.y << ' ' << c.diameter;
  }
}

TEST(Join, LeavesABranchItsOwnRingWhereItBeginsAmidItsParent) {
  Limbs limbs;
  add_limb(limbs, {0, 0, 0}, {0, 1, 0}, {1, 1, 1});
  add_limb(limbs, {0, 1, 0}, {1, 0, 0}, {1, 0.9, 0.8});
  for (std::size_t r = 0; r < 6; ++r) limbs.normal[r] = r < 3 ? Double3{0, 1, 0} : Double3{1, 0, 0};
  LimbSegments segments(limbs);
  join(limbs, segments);
  EXPECT_NE(limbs.limb[0], limbs.limb[3]);
}

TEST(Join, MergesWithARingThatABranchGrowsFromWhereBothLieInOnePlane) {
  Limbs limbs;
  add_limb(limbs, {0, 0, 0}, {0, 1, 0}, {1, 1, 0.2});  // the last is a branch's
  add_limb(limbs, {0, 1, 0}, {0, 1, 0}, {1, 0.9, 0.8});
  for (Double3& n : limbs.normal) n = {0, 1, 0};
  LimbSegments segments(limbs);
  join(limbs, segments);
  EXPECT_EQ(limbs.limb[0], limbs.limb[3]);
}

TEST(Join, DoesNotCloseALoopOfTwoTubes) {
  Limbs limbs;
  add_limb(limbs, {0, 0, 0}, {1, 0, 0}, {1, 1, 1});
  add_limb(limbs, {0, 0, 0}, {1, 0, 0}, {1, 1, 1});
  limbs.centre[1].y = 1, limbs.centre[4].y = -1;
  LimbSegments segments(limbs);
  join(limbs, segments);
  EXPECT_EQ(limbs.limb[0], limbs.limb[3]);
  int merged = 0;
  for (const std::uint32_t m : limbs.merged_into) merged += m != k_none;
  EXPECT_EQ(merged, 1);
}

TEST(Join, ChainsAHundredThousandTubesWithoutQuadraticCost) {
  Limbs limbs;
  for (int i = 0; i < 100000; ++i) add_limb(limbs, {0, 2.0 * i, 0}, {0, 1, 0}, {1, 1, 1});
  LimbSegments segments(limbs);
  join(limbs, segments);
  EXPECT_EQ(end_rings(limbs).size(), 2u);
}

}  // namespace
}  // namespace copse
