#include "lib/analysis/lod/impostor.h"

#include "lib/analysis/measure/view_sphere.h"
#include "tests/measure/shapes_to_draw.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace copse {
namespace {

using Layout = ImpostorOptions::Layout;

std::vector<Material> red() {
  std::vector<Material> m(1);
  m[0].diffuse = {1, 0, 0};
  return m;
}

TEST(Impostor, TheOctahedralMapGoesThereAndBack) {
  for (const Double3& d : view_sphere(3).directions) {
    const auto [u, v] = octahedral_place(d);
    EXPECT_NEAR(distance(octahedral_direction(u, v), d), 0, 1e-12);
  }
  EXPECT_NEAR(distance(octahedral_direction(0, 0), {0, 1, 0}), 0, 1e-12);
  EXPECT_TRUE(is_finite(octahedral_direction(1, 1)));
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

TEST(Impostor, OfNothingIsTransparent) {
  const Impostor i = make_impostor({}, {}, {}, {.views = 2, .size = 4});
  EXPECT_EQ(i.albedo.size(), 4u * 64);
  EXPECT_TRUE(std::all_of(i.albedo.begin(), i.albedo.end(), [](std::uint8_t b) { return b == 0; }));
}

}  // namespace
}  // namespace copse
