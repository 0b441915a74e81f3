#include "lib/analysis/measure/picture.h"

#include "tests/measure/shapes_to_draw.h"

#include <limits>

#include <gtest/gtest.h>

namespace copse {
namespace {

OrthographicView ten_pixels() {
  return {.pixel = 1, .width = 10, .height = 10};
}

TEST(Picture, CoversTheShareOfAPixelThatASquareCovers) {
  const Picture p = draw_picture(square({}, 1.5), {}, ten_pixels(), 4);
  EXPECT_NEAR(covered_pixels(p), 9, 1e-6);
  EXPECT_FLOAT_EQ(p.coverage[5 * 10 + 5], 1);
  EXPECT_FLOAT_EQ(p.coverage[5 * 10 + 6], 0.5);
  EXPECT_FLOAT_EQ(p.coverage[0], 0);
  EXPECT_EQ(p.colour[0], (Float3{1, 1, 1}));
}

TEST(Picture, ShowsTheNearerSurfaceInItsMaterialsColour) {
  std::vector<Material> materials(2);
  materials[0].diffuse = {1, 0, 0}, materials[1].diffuse = {0, 1, 0};
  DrawnMesh m = square({0, 0, 1}, 4, 0);
  append(m, square({0, 0, -1}, 4, 1));
  const Float3 front = draw_picture(m, {materials, {}}, ten_pixels()).colour[55];
  EXPECT_GT(front.x, 0.3f);
  EXPECT_EQ(front.y, 0);
  OrthographicView behind = ten_pixels();
  behind.right = {-1, 0, 0}, behind.toward = {0, 0, -1};
  EXPECT_GT(draw_picture(m, {materials, {}}, behind).colour[55].y, 0.3f);
}

TEST(Picture, LeavesOutWhatTheAlphaTestLeavesOut) {
  const std::vector<AlphaMask> masks{{2, 1, {0, 1}}};  // the left half is transparent
  const std::vector<Material> materials(1);
  const Picture p = draw_picture(square({}, 4, 0), {materials, masks}, ten_pixels());
  EXPECT_NEAR(covered_pixels(p), 32, 1e-6);
  EXPECT_EQ(p.coverage[5 * 10 + 2], 0);
  EXPECT_EQ(p.coverage[5 * 10 + 7], 1);
}

TEST(Picture, SeesThroughAHoleToWhatIsBehind) {
  const std::vector<AlphaMask> masks{{2, 1, {0, 1}}};
  const std::vector<Material> materials(1);
  DrawnMesh m = square({0, 0, 1}, 4, 0);
  append(m, square({0, 0, -1}, 4));
  EXPECT_NEAR(covered_pixels(draw_picture(m, {materials, masks}, ten_pixels())), 64, 1e-6);
}

TEST(Picture, OfNothingOrOfWhatHasNoAreaIsEmpty) {
  EXPECT_EQ(covered_pixels(draw_picture({}, {}, ten_pixels())), 0);
  DrawnMesh m = square({}, 0);
  EXPECT_EQ(covered_pixels(draw_picture(m, {}, ten_pixels())), 0);
  m.positions[0].x = std::numeric_limits<double>::max();
  EXPECT_EQ(draw_picture(m, {}, ten_pixels()).coverage.size(), 100u);
}

TEST(Picture, IsCutAtItsEdges) {
  EXPECT_NEAR(covered_pixels(draw_picture(square({}, 1e6), {}, ten_pixels())), 100, 1e-4);
}

}  // namespace
}  // namespace copse
