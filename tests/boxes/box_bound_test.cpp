#include "lib/analysis/boxes/box_bound.h"

#include "lib/analysis/hull/vertex_widths.h"
#include "tests/volumes/point_sets.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

// The bound for frames about `base`, told of a box of that volume.
BoxBound bound_of(const std::vector<Double3>& points, const Axes& base, double volume, double gap,
                  std::size_t cells = 1'000'000) {
  BoxBoundOptions options;
  options.gap = gap;
  options.max_cells = cells;
  return box_bound(points, base, volume, options);
}

TEST(BoxBound, ProvesTheCubeAndTheBrickWhateverFrameItStartsFrom) {
  for (const Double3& turn : random_cloud(3, 5, {.4, .4, .4})) {
    const Axes base = rotated(k_world_axes, turn);
    for (const double gap : {0.1, 0.01, 1e-4}) {
      const BoxBound cube = bound_of(cube_corners(), base, 1, gap);
      EXPECT_LE(cube.lower_bound, 1);
      EXPECT_GE(cube.lower_bound * (1 + gap), 1 - 1e-12);
    }
  }
}

// No frame, however found, may be below the bound: random frames refined by random steps.
TEST(BoxBound, IsBelowEveryBoxThatCanBeFound) {
  for (int seed = 0; seed < 9; ++seed) {
    const Double3 size = seed % 3 == 0   ? Double3{1, .1, .01}
                         : seed % 3 == 1 ? Double3{1, .9, .8}
                                         : Double3{1, 1, .05};
    const auto points = seed % 2 ? random_cloud(seed, 12 + seed, size) : on_sphere(seed, 10 + 3 * seed);
    const VertexWidths widths(points);
    Random random(seed);
    double best = widths.volume(k_world_axes);
    Axes at = k_world_axes;
    for (int i = 0; i < 3000; ++i) {
      const double reach = i < 1000 ? 0.5 : 0.5 * std::pow(0.998, i - 1000);
      const Axes other =
          rotated(at, Double3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)} * reach);
      if (widths.volume(other) < best) best = widths.volume(other), at = other;
    }
    // Told of the best box with a wide gap, of one that is too large, and given few cells: never above.
    for (const double told : {best, 2 * best}) {
      for (const std::size_t cells : {50u, 1000u, 4000u}) {
        EXPECT_LE(bound_of(points, k_world_axes, told, 1e-3, cells).lower_bound, best * (1 + 1e-12)) << seed;
      }
    }
  }
}

TEST(BoxBound, TellsOfASmallerBoxAndBoundsThatOne) {
  const auto points = cube_corners();
  int calls = 0;
  BoxBoundOptions options;
  options.gap = 1e-3;
  options.improve = [&](const Axes&, double volume) { return ++calls, volume; };
  const BoxBound bound = box_bound(points, rotated(k_world_axes, {.2, .1, 0}), 5, options);
  EXPECT_GT(calls, 0);
  EXPECT_LE(bound.lower_bound, 1);
  EXPECT_GE(bound.lower_bound, 0.99);
}

TEST(BoxBound, EndsAtItsLimitWithWhatIsProven) {
  const auto points = on_sphere(1, 200);
  const BoxBound few = bound_of(points, k_world_axes, 8, 1e-9, 100);
  EXPECT_LE(few.cells, 102u);
  const BoxBound more = bound_of(points, k_world_axes, 8, 1e-9, 5000);
  EXPECT_GE(more.lower_bound, few.lower_bound);
  EXPECT_EQ(bound_of({}, k_world_axes, 8, 0.1).lower_bound, 0);
}

}  // namespace
}  // namespace copse
