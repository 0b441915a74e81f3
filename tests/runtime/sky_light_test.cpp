#include "lib/runtime/sky_light.h"

#include <algorithm>

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

}  // namespace
}  // namespace copse
