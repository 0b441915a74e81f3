#include "lib/runtime/line_point_selection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace copse {
namespace {

std::vector<float> diameters() {
  std::vector<float> out;
  for (int i = 0; i < 500; ++i) out.push_back(0.002f * static_cast<float>(i + 1));
  return out;
}

TEST(LinePointSelection, SegmentsAreDiscardedLinesOrTrianglesAndNothingTwice) {
  const std::vector<float> d = diameters();
  for (double depth = 0.5; depth < 5000; depth *= 1.3) {
    const TrunkSelection s = select_trunk(d, depth, {.pixel = 0.001}, {});
    EXPECT_LE(s.discarded, s.triangles);
    EXPECT_LE(s.triangles, d.size());
    std::uint32_t lines = 0;
    for (int w = 1; w <= k_widest_line; ++w) {
      ASSERT_LE(s.first_of(w), s.end[static_cast<std::size_t>(w)]);
      lines += s.end[static_cast<std::size_t>(w)] - s.first_of(w);
    }
    EXPECT_EQ(s.discarded + lines + (d.size() - s.triangles), d.size());
    EXPECT_EQ(lines, s.lines());
  }
}

TEST(LinePointSelection, ALineIsAsWideAsItsSegmentWithinHalfAPixel) {
  const std::vector<float> d = diameters();
  const double depth = 100, pixel = 0.001;
  const TrunkSelection s = select_trunk(d, depth, {.pixel = pixel}, {.least_width = 1, .largest_width = 5});
  for (int w = 1; w <= 5; ++w) {
    for (std::uint32_t i = s.first_of(w); i < s.end[static_cast<std::size_t>(w)]; ++i)
      EXPECT_NEAR(d[i] / depth / pixel, w, 0.5 + 1e-6) << i;
  }
  EXPECT_LT(d[s.discarded - 1] / depth / pixel, 0.5);
  EXPECT_GE(d[s.triangles] / depth / pixel, 5.5);
}

TEST(LinePointSelection, FartherAwayMoreIsDiscardedAndFewerTrianglesAreLeft) {
  const std::vector<float> d = diameters();
  TrunkSelection before;
  for (double depth = 1; depth < 5000; depth *= 1.2) {
    const TrunkSelection s = select_trunk(d, depth, {.pixel = 0.001}, {});
    EXPECT_GE(s.discarded, before.discarded);
    EXPECT_GE(s.triangles, before.triangles);
    before = s;
  }
  EXPECT_EQ(before.discarded, d.size());
}

TEST(LinePointSelection, BehindTheEyeEverythingIsTriangles) {
  for (const double depth : {0.0, -3.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(select_trunk(diameters(), depth, {}, {}).triangles, 0u);
    LeafGroup group{.mean_area = 0.01f, .count = 7};
    EXPECT_EQ(select_group(group, depth, {}, {}).end_leaf, 7u);
    EXPECT_EQ(select_group(group, depth, {}, {}).points(), 0u);
  }
  EXPECT_EQ(select_trunk({}, 10, {}, {}).triangles, 0u);
}

// r = points / leaves; in the mixed band the drawn area is (r^2 - 2 r + 2) / r of the estimate.
TEST(LinePointSelection, LeavesGoFromTrianglesOverBothToPointsWithoutAJump) {
  const LeafGroup group{.mean_area = 0.01f, .count = 10000};
  const double pixel = 0.001, side = 2 * pixel;
  double before = -1;
  for (double depth = 10; depth < 400; depth *= 1.003) {
    const GroupSelection s = select_group(group, depth, {.pixel = pixel}, {});
    const double estimate = group.count * double{group.mean_area} / (1.8 * depth * depth);
    const double r = estimate / (side * side) / group.count;
    const double drawn = s.points() * side * side +
                         (s.end_leaf - s.first_leaf) * double{group.mean_area} / (1.8 * depth * depth);
    const double share = drawn / estimate, wanted = r >= 1 && r < 2 ? (r * r - 2 * r + 2) / r : 1;
    EXPECT_NEAR(share, wanted, 0.001 + 1.0 / std::max(1u, s.points())) << r;  // whole points
    if (before > 0) {
      EXPECT_NEAR(share, before, 0.02);
    }
    before = share;
    EXPECT_LE(s.end_point, group.count);
    const bool outermost = s.end_point == group.count, innermost = s.first_point == 0;
    EXPECT_TRUE(r < 1 ? outermost : innermost);
  }
}

TEST(LinePointSelection, AScaledInstanceIsAsCloseAsItLooks) {
  const std::vector<float> d = diameters();
  const TrunkSelection a = select_trunk(d, 50, {.pixel = 0.001, .scale = 1}, {}),
                       b = select_trunk(d, 100, {.pixel = 0.001, .scale = 2}, {});
  EXPECT_EQ(a.discarded, b.discarded);
  EXPECT_EQ(a.end, b.end);
}

}  // namespace
}  // namespace copse
