#include "lib/analysis/rings/polyline_simplification.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace copse {
namespace {

using Keep = std::vector<std::uint8_t>;

Keep ends(std::size_t n) {
  Keep keep(n, 0);
  keep.front() = keep.back() = 1;
  return keep;
}

// The heights y over 0, 1, 2, ..., that the line between a and b may miss by `allowed`.
PointNeed off_line(const std::vector<double>& y, double allowed) {
  return [&y, allowed](std::size_t a, std::size_t b, std::size_t i) {
    const double at = static_cast<double>(i - a) / static_cast<double>(b - a);
    return std::abs(y[a] + (y[b] - y[a]) * at - y[i]) / allowed;
  };
}

std::size_t worst_breach(const Keep& keep, const PointNeed& need) {
  std::size_t last = keep.size(), breaches = 0;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (!keep[i]) continue;
    for (std::size_t j = last + 1; last < i && j < i; ++j) breaches += need(last, i, j) > 1;
    last = i;
  }
  return breaches;
}

TEST(PolylineSimplification, FindsTheCornersThatALineWasMadeFrom) {
  std::vector<double> y;
  for (int i = 0; i <= 60; ++i) y.push_back(i < 20 ? i : i < 45 ? 20 : 65 - i);
  Keep keep = ends(y.size()), expected = keep;
  simplify_polyline(keep, off_line(y, 1e-6));
  expected[20] = expected[45] = 1;
  EXPECT_EQ(keep, expected);
}

TEST(PolylineSimplification, KeepsNothingMoreOfAStraightLineAndAllOfAZigzag) {
  Keep straight = ends(1000);
  simplify_polyline(straight, [](std::size_t, std::size_t, std::size_t) { return 1.0; });
  EXPECT_EQ(straight, ends(1000));
  std::vector<double> y(1000);
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = static_cast<double>(i % 2);
  Keep zigzag = ends(y.size());
  simplify_polyline(zigzag, off_line(y, 0.25));
  EXPECT_EQ(zigzag, Keep(y.size(), 1));
}

TEST(PolylineSimplification, LeavesAloneWhatLiesOutsideTheOnesThatStay) {
  Keep keep{0, 0, 1, 0, 0, 1, 0, 1, 0};
  simplify_polyline(keep, [](std::size_t, std::size_t, std::size_t) { return 2.0; });
  EXPECT_EQ(keep, (Keep{0, 0, 1, 1, 1, 1, 1, 1, 0}));
  for (Keep few : {Keep{}, Keep{1}, Keep{0, 0}, Keep{1, 1}}) {
    const Keep before = few;
    simplify_polyline(few, [](std::size_t, std::size_t, std::size_t) { return 2.0; });
    EXPECT_EQ(few, before);
  }
}

TEST(PolylineSimplification, WhatIsNoNumberIsNotNeeded) {
  Keep keep = ends(9);
  simplify_polyline(keep, [](std::size_t, std::size_t, std::size_t) { return std::nan(""); });
  EXPECT_EQ(keep, ends(9));
}

TEST(PolylineSimplification, AsksNotQuadraticallyOftenWhereEndsAreSplitOffOneByOne) {
  constexpr std::size_t k_points = 100'000;
  // Always the first, always the last, and a curve that straightens: halves are never even.
  std::vector<double> curve(k_points);
  for (std::size_t i = 0; i < k_points; ++i)
    curve[i] = std::ldexp(1.0, -static_cast<int>(i / 64)) * double(i % 64);
  const PointNeed first = [](std::size_t a, std::size_t, std::size_t i) { return i == a + 1 ? 2.0 : 0.0; };
  const PointNeed last = [](std::size_t, std::size_t b, std::size_t i) { return i + 1 == b ? 2.0 : 0.0; };
  const PointNeed bent = off_line(curve, 1e-300);
  for (const PointNeed* need : {&first, &last, &bent}) {
    std::size_t asked = 0;
    Keep keep = ends(k_points);
    simplify_polyline(keep,
                      [&](std::size_t a, std::size_t b, std::size_t i) { return ++asked, (*need)(a, b, i); });
    EXPECT_LT(asked, 20 * k_points * 17);
    EXPECT_EQ(worst_breach(keep, *need), 0u);
  }
}

RC_GTEST_PROP(PolylineSimplification, NothingThatIsLeftOutIsNeeded,
              (const std::vector<std::int8_t>& heights)) {
  RC_PRE(heights.size() >= 2);
  const std::vector<double> y(heights.begin(), heights.end());
  Keep keep = ends(y.size());
  simplify_polyline(keep, off_line(y, 10));
  RC_ASSERT(worst_breach(keep, off_line(y, 10)) == 0u);
}

}  // namespace
}  // namespace copse
