#include "lib/analysis/boxes/box_search.h"

#include "tests/volumes/point_sets.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(BoxSearch, DescendsFromAnywhereNearToTheBrick) {
  const auto brick = turned(
      {{0, 0, 0}, {.9, 0, 0}, {0, .5, 0}, {.9, .5, 0}, {0, 0, .1}, {.9, 0, .1}, {0, .5, .1}, {.9, .5, .1}},
      {1, 2, 3}, {0, 1, 1});
  const VertexWidths widths(brick);
  const Double3 u = normalized({1, 2, 3}), w = normalized(cross(u, {0, 1, 1}));
  const Axes exact{u, cross(w, u), w};
  EXPECT_NEAR(widths.volume(exact), .045, 1e-15);
  for (const Double3& turn : random_cloud(3, 20, {.1, .1, .1})) {
    const Axes start = rotated(exact, turn);
    const FrameVolume end = descend(brick, widths, {start, widths.volume(start)});
    EXPECT_NEAR(end.volume, .045, .045 * 1e-6);
    EXPECT_EQ(end.volume, widths.volume(end.axes));
  }
}

TEST(BoxSearch, TurningToTheRectangleKeepsTheAxisAndNeverLoses) {
  const auto points = random_cloud(9, 200, {1, .5, .2});
  const VertexWidths widths(points);
  for (const Double3& turn : random_cloud(4, 20, {.4, .4, .4})) {
    const Axes start = rotated(k_world_axes, turn);
    for (int i = 0; i < 3; ++i) {
      const Axes end = turned_to_rectangle(points, start, i);
      EXPECT_EQ(end[i], start[i]);
      EXPECT_LE(widths.volume(end), widths.volume(start) * (1 + 1e-12));
      EXPECT_NEAR(length(cross(end[0], end[1]) - end[2]), 0, 1e-14);
    }
  }
}

TEST(BoxSearch, SimplexStepsNeverLoseEvenOnANeedle) {
  const auto needle = turned(random_cloud(1, 300, {1, 1e-7, 2e-7}), {1, 2, 3}, {-3, 1, 2});
  const VertexWidths widths(needle);
  FrameVolume start{axes_along({1, 2, 3.0001}, {-3, 1, 2}), 0};
  start.volume = widths.volume(start.axes);
  const FrameVolume end = simplex_descent(widths, start, 0.25, 200);
  EXPECT_LT(end.volume, start.volume);
}

}  // namespace
}  // namespace copse
