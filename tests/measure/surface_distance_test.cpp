#include "lib/analysis/measure/surface_distance.h"

#include "lib/formats/random.h"
#include "tests/measure/shapes_to_draw.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(SurfaceDistance, OfASurfaceToItselfIsNothing) {
  const SurfaceDistances d = surface_distance(square({}, 1), square({}, 1));
  EXPECT_NEAR(d.from_level.max, 0, 1e-12);
  EXPECT_NEAR(d.from_source.max, 0, 1e-12);
}

TEST(SurfaceDistance, BetweenParallelSheetsIsTheirDistance) {
  const SurfaceDistances d = surface_distance(square({}, 1), square({0, 0, 0.25}, 1));
  EXPECT_NEAR(d.from_level.mean, 0.25, 1e-12);
  EXPECT_NEAR(d.from_level.rms, 0.25, 1e-12);
  EXPECT_NEAR(d.from_source.max, 0.25, 1e-12);
}

TEST(SurfaceDistance, IsOneSided) {
  DrawnMesh half = square({}, 1);
  half.triangles.pop_back(), half.material.pop_back();
  const SurfaceDistances d = surface_distance(square({}, 1), half);
  EXPECT_NEAR(d.from_level.max, 0, 1e-12) << "what is left lies on the source";
  // The far half's mean distance from the diagonal: a third of its height sqrt(2), over half of the area.
  EXPECT_NEAR(d.from_source.mean, std::sqrt(2.0) / 6, 0.005);
  EXPECT_GT(d.from_source.max, 1.3);
}

TEST(SurfaceDistance, FindsTheNearestOfManyTriangles) {
  DrawnMesh many;
  const Random root(3);
  for (int i = 0; i < 300; ++i) {
    Random draw = root.fork(i);
    append(many, square({draw.uniform(-5, 5), draw.uniform(-5, 5), draw.uniform(-5, 5)}, 0.2));
  }
  DrawnMesh reversed = many;
  std::reverse(reversed.triangles.begin(), reversed.triangles.end());
  const DrawnMesh other = square({0.3, 0.1, 0}, 3);
  EXPECT_DOUBLE_EQ(surface_distance(many, other).from_level.mean,
                   surface_distance(reversed, other).from_level.mean);
  EXPECT_NEAR(surface_distance(many, many).from_level.max, 0, 1e-12);
}

TEST(SurfaceDistance, ToNothingIsInfinite) {
  const SurfaceDistances d = surface_distance(square({}, 1), {});
  EXPECT_EQ(d.from_source.mean, std::numeric_limits<double>::infinity());
  EXPECT_EQ(d.from_level.mean, 0);
}

TEST(SurfaceDistance, ToDegenerateTrianglesIsFinite) {
  DrawnMesh point = square({2, 0, 0}, 0);
  EXPECT_NEAR(surface_distance(square({}, 1), point).from_source.max, 3.16, 0.05);
}

}  // namespace
}  // namespace copse
