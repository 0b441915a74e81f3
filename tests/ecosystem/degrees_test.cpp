#include "lib/analysis/ecosystem/degrees.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(Degrees, QuarterTurnsAreExact) {
  for (int quarter = -8; quarter <= 8; ++quarter) {
    const SinCos s = sin_cos_degrees(90.0 * quarter);
    const int turn = ((quarter % 4) + 4) % 4;
    EXPECT_EQ(s.sin, turn == 1 ? 1 : turn == 3 ? -1 : 0) << quarter;
    EXPECT_EQ(s.cos, turn == 0 ? 1 : turn == 2 ? -1 : 0) << quarter;
  }
}

TEST(Degrees, AgreesWithTheLibraryWithinAUnitInTheLastPlace) {
  for (double d = -360; d <= 360; d += 0.37) {
    const SinCos s = sin_cos_degrees(d);
    EXPECT_NEAR(s.sin, std::sin(d * std::numbers::pi / 180), 2e-15) << d;
    EXPECT_NEAR(s.cos, std::cos(d * std::numbers::pi / 180), 2e-15) << d;
    EXPECT_NEAR(s.sin * s.sin + s.cos * s.cos, 1, 3e-16);
  }
}

TEST(Degrees, AMillionDegreesAreWholeTurnsAndTheRest) {
  EXPECT_EQ(sin_cos_degrees(1e6).sin, sin_cos_degrees(280).sin);  // 1e6 = 2777 * 360 + 280
  EXPECT_EQ(sin_cos_degrees(-1e6).cos, sin_cos_degrees(-280).cos);
  EXPECT_EQ(sin_cos_degrees(360e15).cos, 1);
}

}  // namespace
}  // namespace copse
