#include "lib/runtime/sky_light.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace copse {
namespace {

float received(const SkyLight& sky, const Float3& at, const Float3& normal) {
  std::array<std::size_t, 3> c{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int a = static_cast<int>(axis);
    c[axis] = static_cast<std::size_t>((at[a] - sky.corner[a]) / sky.cell);
    EXPECT_LT(c[axis], sky.size[axis]);
  }
  const Float4& l = sky.cells[c[0] + sky.size[0] * (c[1] + sky.size[1] * c[2])];
  return std::max(0.0f, l.w + l.x * normal.x + l.y * normal.y + l.z * normal.z);
}

// A square of side 2 at height y that faces up, cut into n * n * 2 triangles.
TreeGeometry plate(float y, int n) {
  TreeGeometry g;
  const float step = 2.0f / static_cast<float>(n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const float x = -1 + step * static_cast<float>(i), z = -1 + step * static_cast<float>(j);
      const auto v = static_cast<std::uint32_t>(g.vertices.size());
      for (const Float3& p : {Float3{x, y, z}, {x, y, z + step}, {x + step, y, z + step}, {x + step, y, z}}) {
        g.vertices.push_back({p, {0, 1, 0}, {}});
        g.bounds.grow(p);
      }
      for (const std::uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) g.indices.push_back(v + k);
    }
  }
  g.ranges = {{DrawPart::leaves, k_none, 0, static_cast<std::uint32_t>(g.indices.size())}};
  return g;
}

TEST(SkyLight, OfNothingIsTheOpenSky) {
  const SkyLight sky = make_sky_light({}, {});
  ASSERT_EQ(sky.cells.size(), 1u);
  EXPECT_FLOAT_EQ(sky.cells[0].w + sky.cells[0].y, 1);
  EXPECT_FLOAT_EQ(sky.cells[0].w - sky.cells[0].y, 0);
}

TEST(SkyLight, AboveEverythingTheSkyIsOpen) {
  const float opaque[] = {1};
  const SkyLight sky = make_sky_light(plate(0, 4), opaque);
  EXPECT_NEAR(received(sky, {0, 0.9f, 0}, {0, 1, 0}), 1, 0.02);
  EXPECT_NEAR(received(sky, {0, 0.9f, 0}, {0, -1, 0}), 0, 0.02);
  EXPECT_NEAR(received(sky, {0, 0.9f, 0}, {1, 0, 0}), 0.5, 0.02);
}

TEST(SkyLight, ItIsDarkerUnderAPlateAndDarkestInTheMiddle) {
  const float opaque[] = {20};  // twenty layers
  const SkyLight sky = make_sky_light(plate(0, 4), opaque);
  const float middle = received(sky, {0, -0.15f, 0}, {0, 1, 0});
  const float edge = received(sky, {0.95f, -0.15f, 0}, {0, 1, 0});
  const float outside = received(sky, {1.8f, -0.15f, 0}, {0, 1, 0});
  EXPECT_LT(middle, 0.35f);
  EXPECT_LT(middle, edge);
  EXPECT_LT(edge, outside);
  EXPECT_GT(outside, 0.75f);
}

TEST(SkyLight, LightComesFromTheOpenSide) {
  const float opaque[] = {20};
  const SkyLight sky = make_sky_light(plate(0, 4), opaque);
  const Float3 at{1.05f, -0.2f, 0};
  EXPECT_GT(received(sky, at, {1, 0, 0}), received(sky, at, {-1, 0, 0}) + 0.1f);
}

TEST(SkyLight, DoesNotDependOnHowASurfaceIsCut) {
  const float opaque[] = {1};
  const SkyLight coarse = make_sky_light(plate(0, 1), opaque), fine = make_sky_light(plate(0, 64), opaque);
  EXPECT_NEAR(received(coarse, {0, -0.3f, 0}, {0, 1, 0}), received(fine, {0, -0.3f, 0}, {0, 1, 0}), 0.02);
}

TEST(SkyLight, TransparentLeavesCastNoShade) {
  const float clear[] = {0};
  const SkyLight sky = make_sky_light(plate(0, 4), clear);
  EXPECT_NEAR(received(sky, {0, -0.5f, 0}, {0, 1, 0}), 1, 0.02);
}

TEST(SkyLight, APointAndATinyTreeAreFinite) {
  TreeGeometry g = plate(0, 1);
  for (DrawVertex& v : g.vertices) v.position = v.position * 1e-30f;
  g.bounds = {{-1e-30f, 0, -1e-30f}, {1e-30f, 0, 1e-30f}};
  const float opaque[] = {1};
  for (const Float4& c : make_sky_light(g, opaque, 8).cells) {
    EXPECT_TRUE(std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z) && std::isfinite(c.w));
  }
}

// A wood of 100 m x 100 m, 10 m high: so much projected area over every square metre.
SkyLight wood(float area_a_square_metre, std::size_t resolution = 64) {
  std::vector<SkyOccluder> leaves;
  for (int x = 0; x < 200; ++x)
    for (int z = 0; z < 200; ++z)
      leaves.push_back(
          {{0.5f * static_cast<float>(x) + 0.25f, static_cast<float>((7 * x + 3 * z) % 10) + 0.5f,
            0.5f * static_cast<float>(z) + 0.25f},
           0.25f * area_a_square_metre});
  return make_sky_light(leaves, {{0, 0, 0}, {100, 10, 100}}, resolution);
}

// Straight down exp(-area) would be left; slanting rays have a longer way.
TEST(SkyLight, UnderAWoodItIsAsDarkAsALayerOfThatDensity) {
  for (const float area : {0.25f, 1.0f, 3.0f}) {
    const float left = received(wood(area), {50, 0.2f, 50}, {0, 1, 0});
    double expected = 0, all = 0;
    for (int k = 0; k < 1000; ++k) {  // 2 * integral of exp(-area / c) * c over the cosine c of the slant
      const double c = (k + 0.5) / 1000;
      expected += c * std::exp(-double{area} / c), all += c;
    }
    EXPECT_NEAR(left, expected / all, 0.08) << area;
  }
}

TEST(SkyLight, BesideAndAboveAWoodTheSkyOpens) {
  const SkyLight sky = wood(3);
  EXPECT_GT(received(sky, {50, 11, 50}, {0, 1, 0}), 0.95f);
  EXPECT_GT(received(sky, {-2, 5, 50}, {-1, 0, 0}), 0.4f);
  EXPECT_LT(received(sky, {-2, 5, 50}, {1, 0, 0}), 0.25f);
  EXPECT_NEAR(sky.opens.x, 1 - 4 / 64.0, 0.005);
  EXPECT_GT(sky.opens.y, 1);
}

TEST(SkyLight, AWideWoodHasFewLayersOfCells) {
  const SkyLight sky = wood(1);
  EXPECT_EQ(sky.size[0], 64u);
  EXPECT_EQ(sky.size[2], 64u);
  EXPECT_LE(sky.size[1], 8u);
}

TEST(SkyLight, OccludersWithoutASizeOrAPlaceAreNone) {
  const float huge = std::numeric_limits<float>::infinity();
  const SkyOccluder bad[] = {
      {{0, 0, 0}, huge}, {{huge, 0, 0}, 1}, {{0, 0, 0}, std::nanf("")}, {{0, 0, 0}, -5}};
  for (const Float4& c : make_sky_light(bad, {{0, 0, 0}, {1, 1, 1}}, 8).cells) EXPECT_NEAR(c.w, 0.5f, 1e-6);
  EXPECT_EQ(make_sky_light(std::span<const SkyOccluder>(), {{0, 0, 0}, {1, 1, 1}}, 8).cells.size(), 1u);
  EXPECT_EQ(make_sky_light(std::span(bad), FloatBox{}, 8).cells.size(), 1u);
}

}  // namespace
}  // namespace copse
