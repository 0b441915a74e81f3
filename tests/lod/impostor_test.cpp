#include "lib/analysis/lod/impostor.h"

#include "lib/analysis/measure/view_sphere.h"
#include "tests/measure/shapes_to_draw.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

using Layout = ImpostorLayout;

std::vector<Material> red() {
  std::vector<Material> m(1);
  m[0].diffuse = {1, 0, 0};
  return m;
}

TEST(Impostor, OfASquareShowsItFromTheFrontAndNotFromTheSide) {
  const Impostor i =
      make_impostor(square({}, 1, 0), red(), {}, {.layout = Layout::billboard, .views = 4, .size = 32});
  EXPECT_EQ(i.width, 128);
  EXPECT_EQ(i.height, 32);
  ASSERT_EQ(i.views.size(), 4u);
  const auto covered = [&](int view) {
    double sum = 0;
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 32; ++x) sum += i.albedo[4 * (y * 128 + 32 * view + x) + 3] / 255.0;
    return sum / (32 * 32);
  };
  EXPECT_NEAR(covered(0), 0.5, 0.01) << "a square in the square round its circle";
  EXPECT_NEAR(covered(1), 0, 1e-9);
  EXPECT_NEAR(covered(2), 0.5, 0.01);
  const std::size_t middle = 16 * 128 + 16;
  EXPECT_EQ(i.albedo[4 * middle], 255);
  EXPECT_EQ(i.albedo[4 * middle + 1], 0);
  EXPECT_NEAR(i.normal[4 * middle + 2], 255, 1);
  EXPECT_NEAR(i.normal[4 * middle], 127.5, 1);
  EXPECT_NEAR(i.depth[middle], 127.5, 1);
}

TEST(Impostor, EmptyPixelsOfAViewHaveItsColoursForFiltering) {
  const Impostor i =
      make_impostor(square({}, 1, 0), red(), {}, {.layout = Layout::billboard, .views = 1, .size = 16});
  EXPECT_EQ(i.albedo[3], 0) << "a corner is empty";
  EXPECT_EQ(i.albedo[0], 255) << "and red all the same";
}

TEST(Impostor, TakesColourAndHolesFromTheTexture) {
  const std::vector<std::uint8_t> texels{0, 255, 0, 255, 0, 255, 0, 0};  // left green, right a hole
  std::vector<Material> m(1);
  m[0].diffuse = {1, 1, 1}, m[0].texture = 0;
  const auto images = [&](std::uint32_t) { return TextureImage{2, 1, texels}; };
  const Impostor i =
      make_impostor(square({}, 1, 0), m, images, {.layout = Layout::billboard, .views = 1, .size = 32});
  const std::size_t left = 16 * 32 + 10, right = 16 * 32 + 22;
  EXPECT_EQ(i.albedo[4 * left + 1], 255);
  EXPECT_EQ(i.albedo[4 * left], 0);
  EXPECT_EQ(i.albedo[4 * left + 3], 255);
  EXPECT_EQ(i.albedo[4 * right + 3], 0);
}

TEST(Impostor, OctahedralAtlasHasAViewACell) {
  const Impostor i = make_impostor(square({}, 1, 0), red(), {}, {.views = 4, .size = 8});
  EXPECT_EQ(i.views.size(), 16u);
  EXPECT_EQ(i.width, 32);
  EXPECT_EQ(i.height, 32);
}

TEST(Impostor, ViewsLieAsTheFileSaysTheyDo) {
  for (const Double3& d : view_sphere(2).directions) {
    const OrthographicView view = view_of_sphere({}, 1, d, 8);
    const ImpostorFrame frame = impostor_frame(d);
    EXPECT_NEAR(distance(frame.right, view.right), 0, 1e-12);
    EXPECT_NEAR(distance(frame.up, view.up), 0, 1e-12);
  }
}

TEST(Impostor, DrawnFromItsOwnViewsItIsThePictureThatWasTaken) {
  const DrawnMesh mesh = square({0.2, 0.1, 0.3}, 0.5, 0);
  const Impostor i = make_impostor(mesh, red(), {}, {.views = 6, .size = 48});
  const std::vector<Material> materials = red();
  const Looks looks{materials, {}};
  double both = 0, either = 0;
  for (const Double3& d : i.views) {
    if (std::abs(d.z) < 0.5) continue;
    const OrthographicView view = view_of_sphere(i.centre, i.radius, d, 48);
    const Picture drawn = draw_impostor(i, view), real = draw_picture(mesh, looks, view, 3);
    for (std::size_t p = 0; p < drawn.coverage.size(); ++p) {
      both += std::min(drawn.coverage[p], real.coverage[p]);
      either += std::max(drawn.coverage[p], real.coverage[p]);
    }
  }
  EXPECT_GT(both / either, 0.97);
}

// Between the views depth puts things where they belong: a square off the middle is met where it is.
TEST(Impostor, BetweenTheViewsDepthKeepsThingsInTheirPlaces) {
  DrawnMesh mesh = square({0, 0, 1}, 0.3, 0);
  append(mesh, square({0, 0, -1}, 0.3, 0));
  const Impostor i = make_impostor(mesh, red(), {}, {.views = 8, .size = 64});
  const Double3 between = normalized(i.views[27] + i.views[28]);
  const OrthographicView view = view_of_sphere(i.centre, i.radius, between, 64);
  const std::vector<Material> materials = red();
  const Picture drawn = draw_impostor(i, view), real = draw_picture(mesh, {materials, {}}, view, 3);
  double both = 0, either = 0;
  for (std::size_t p = 0; p < drawn.coverage.size(); ++p) {
    both += std::min(drawn.coverage[p], real.coverage[p]);
    either += std::max(drawn.coverage[p], real.coverage[p]);
  }
  EXPECT_GT(both / std::max(either, 1e-9), 0.7);
}

TEST(Impostor, OfNothingIsTransparent) {
  const Impostor i = make_impostor({}, {}, {}, {.views = 2, .size = 4});
  EXPECT_EQ(i.albedo.size(), 4u * 64);
  EXPECT_TRUE(std::all_of(i.albedo.begin(), i.albedo.end(), [](std::uint8_t b) { return b == 0; }));
}

}  // namespace
}  // namespace copse
