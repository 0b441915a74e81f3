#include "lib/analysis/hull/grid_axis.h"

#include "lib/formats/random.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace copse {
namespace {

Double3 random_direction(Random& random) {
  const double z = random.around(0, 1), a = random.uniform(0, 2 * std::numbers::pi);
  const double r = std::sqrt(std::max(0.0, 1 - z * z));
  return {r * std::cos(a), r * std::sin(a), z};
}

AxisToRound random_axis(Random& random, double place, double length, double radius, double reach) {
  const Double3 low{random.around(0, place), random.around(0, place), random.around(0, place)};
  return {low, random_direction(random), length, radius, reach};
}

bool is_float(const Double3& p) {
  return to_double(to_float(p)) == p;
}

double off_line(const AxisToRound& axis, const Double3& p) {
  const Double3 d = p - axis.low;
  return length(d - axis.direction * dot(d, axis.direction));
}

TEST(GridAxis, EndsAndTheirDifferenceAreFloats) {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const double place = std::pow(10, random.uniform(-3, 7)), length = std::pow(10, random.uniform(-6, 3));
    const double radius = length * std::pow(10, random.uniform(-12, 3)), reach = i % 2 == 0 ? radius : 0;
    const GridAxis ends = grid_axis(random_axis(random, place, length, radius, reach), 24);
    EXPECT_TRUE(is_float(ends.a) && is_float(ends.b) && is_float(ends.b - ends.a))
        << place << " " << length << " " << radius;
  }
}

TEST(GridAxis, OfANeedleLieManyTimesNearerToTheLineThanTheNearestFloats) {
  Random random(2);
  double nearest = 0, chosen = 0, longer = 0;
  constexpr int k_axes = 200;
  for (int i = 0; i < k_axes; ++i) {
    const AxisToRound axis = random_axis(random, 1, 1, 1e-9, 0);
    const GridAxis ends = grid_axis(axis, 24);
    const Double3 high = axis.low + axis.direction * axis.length;
    nearest +=
        std::max(off_line(axis, to_double(to_float(axis.low))), off_line(axis, to_double(to_float(high))));
    chosen += std::max(off_line(axis, ends.a), off_line(axis, ends.b));
    longer = std::max(longer, length(ends.b - ends.a) / axis.length - 1);
  }
  EXPECT_LT(chosen, nearest / 4);
  EXPECT_LT(longer, 2e-4);
}

// What lies between the planes at `length` apart, as far as `reach` across, stays between those through the
// ends.
TEST(GridAxis, PlanesThroughTheEndsHoldWhatIsBetween) {
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const double reach = std::pow(10, random.uniform(-6, 2));
    const double length = i % 3 == 0 ? 0 : reach * std::pow(10, random.uniform(-9, 3));
    const AxisToRound axis = random_axis(random, i % 2 == 0 ? 1 : 100, length, reach, reach);
    const GridAxis ends = grid_axis(axis, 24);
    const Double3 d = ends.b - ends.a;
    ASSERT_GT(dot(d, axis.direction), 0);
    const Double3 u = normalized(cross(axis.direction, random_direction(random))),
                  v = cross(axis.direction, u);
    for (int k = 0; k < 12; ++k) {
      const double angle = 2 * std::numbers::pi * k / 12;
      for (const double along : {0.0, length}) {
        const Double3 p =
            axis.low + axis.direction * along + (u * std::cos(angle) + v * std::sin(angle)) * reach;
        const double rounding = 1e-14 * (copse::length(p) + 100) * copse::length(d);
        EXPECT_GE(dot(p - ends.a, d), -rounding) << reach << " " << length;
        EXPECT_LE(dot(p - ends.b, d), rounding) << reach << " " << length;
      }
    }
  }
}

// Ends at the nearest floats tell a disc's axis when they are the root of a unit apart: 3.5e-4.
TEST(GridAxis, OfADiscWithoutThicknessAreATenthAsFarApartAsNearestFloatsMustBe) {
  Random random(4);
  double sum = 0, most = 0;
  constexpr int k_axes = 100;
  for (int i = 0; i < k_axes; ++i) {
    const GridAxis ends = grid_axis(random_axis(random, 1, 0, 1, 1), 24);
    sum += length(ends.b - ends.a), most = std::max(most, length(ends.b - ends.a));
  }
  EXPECT_LT(sum / k_axes, 5e-5);
  EXPECT_LT(most, 1.5e-4);
}

TEST(GridAxis, OfWhatIsThickAreTheNearestNumbers) {
  const AxisToRound axis{{0.1, 0.2, 0.3}, {1, 0, 0}, 2, 0.5, 0};
  const GridAxis ends = grid_axis(axis, 24);
  EXPECT_LT(distance(ends.a, axis.low), 3e-7);
  EXPECT_LT(distance(ends.b, axis.low + axis.direction * 2), 3e-7);
  const GridAxis fine = grid_axis(axis, 53);
  EXPECT_LT(distance(fine.a, axis.low), 1e-15);
}

TEST(GridAxis, WithoutADirectionOrNumbersHasBothEndsInOnePlace) {
  const GridAxis none = grid_axis({{0.1, 0.2, 0.3}, {}, 1, 0, 0}, 24);
  EXPECT_EQ(none.a, none.b);
  const GridAxis point = grid_axis({{0.1, 0.2, 0.3}, {0, 1, 0}, 0, 1, 0}, 24);
  EXPECT_EQ(point.a, point.b);
  const double huge = std::numeric_limits<double>::infinity();
  const GridAxis infinite = grid_axis({{huge, 0, 0}, {0, 1, 0}, 1, 1, 1}, 24);
  EXPECT_EQ(infinite.a.y, infinite.b.y);
}

}  // namespace
}  // namespace copse
