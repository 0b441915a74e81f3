#include "lib/analysis/ecosystem/random_faults.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace copse {
namespace {

std::vector<Double3> grid(std::size_t side) {
  std::vector<Double3> v;
  for (std::size_t r = 0; r < side; ++r)
    for (std::size_t c = 0; c < side; ++c) v.push_back({static_cast<double>(c), 0, static_cast<double>(r)});
  return v;
}

TEST(RandomFaults, OneFaultRaisesOneSideAndLowersTheOther) {
  auto v = grid(20);
  apply_faults(v, 20, {.count = 1, .first = 3}, Random(4));
  std::size_t up = 0;
  for (const Double3& p : v) {
    EXPECT_EQ(std::abs(p.y), 1.5);
    up += p.y > 0;
  }
  EXPECT_GT(up, 0u);
  EXPECT_LT(up, v.size());
}

TEST(RandomFaults, HeightsStayWithinHalfTheSumOfTheSteps) {
  auto v = grid(40);
  apply_faults(v, 40, {.count = 1000, .first = 2, .last = 0}, Random(1));
  double sum = 0;
  for (const Double3& p : v) {
    EXPECT_LE(std::abs(p.y), 500.0001);
    sum += p.y;
  }
  EXPECT_LT(std::abs(sum / static_cast<double>(v.size())), 40);  // zero-mean steps do not drift (hazard H34)
}

TEST(RandomFaults, SmoothingKeepsABorderAndAPlane) {
  auto v = grid(9);
  for (Double3& p : v) p.y = 2 * p.x - p.z;
  const auto before = v;
  apply_faults(v, 9, {.count = 0, .smooth = 5}, Random(1));
  for (std::size_t i = 0; i < v.size(); ++i) EXPECT_NEAR(v[i].y, before[i].y, 1e-12);
}

TEST(RandomFaults, AreTheSameForAnyNumberOfThreads) {
  auto one = grid(300), many = one;
  const FaultOptions options{.count = 50, .first = 4, .last = 1, .smooth = 2};
  {
    const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
    apply_faults(one, 300, options, Random(7));
  }
  apply_faults(many, 300, options, Random(7));
  EXPECT_EQ(one, many);
}

TEST(RandomFaults, NothingIsBrokenWhereThereIsNothing) {
  std::vector<Double3> none;
  apply_faults(none, 1, {.count = 3, .first = 1}, Random(1));
  std::vector<Double3> point(1);
  apply_faults(point, 1, {.count = 3, .first = 1, .smooth = 3}, Random(1));
  EXPECT_TRUE(std::isfinite(point[0].y));
}

}  // namespace
}  // namespace copse
