#include "lib/runtime/shadow_cascades.h"

#include "lib/formats/random.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

const DoubleBox k_scene{{-2000, -50, -2000}, {2000, 150, 2000}};
const Double3 k_sun = normalized({0.4, 0.7, 0.3});
const CascadeWish k_wish{.count = 4, .texels = 1024, .nearest = 2, .farthest = 600};

Camera camera_at(Random& random) {
  const Double3 eye{random.uniform(-1500, 1500), random.uniform(0, 90), random.uniform(-1500, 1500)};
  return {.eye = eye,
          .target = eye + Double3{random.uniform(-1, 1), random.uniform(-0.4, 0.3), random.uniform(-1, 1)},
          .fov = random.uniform(0.3, 1.2)};
}

Float4 in_map(const ShadowCascade& c, const Double3& p, const Double3& origin) {
  const Float3 local = to_float(p - origin);
  return transform(c.clip, {local.x, local.y, local.z, 1});
}

TEST(ShadowCascades, EveryPointOfASliceThatIsInTheSceneIsInItsMap) {
  Random random(1);
  const Double3 origin{7, 1, -9};
  std::size_t tested = 0;
  for (int n = 0; n < 200; ++n) {
    const View view = make_view(camera_at(random), 1.6, 0.1, 1e5);
    const ShadowCascades s = shadow_cascades(view, k_sun, k_scene, origin, k_wish);
    ASSERT_GE(s.count, 1u);
    for (int i = 0; i < 200; ++i) {
      const double along = random.uniform(0, k_wish.farthest);
      const Double3 p = view.eye - view.frame.back * along +
                        view.frame.right * (random.uniform(-1, 1) * along * view.tan_half_x) +
                        view.frame.up * (random.uniform(-1, 1) * along * view.tan_half_y);
      bool inside = true;
      for (int a = 0; a < 3; ++a) inside &= p[a] >= k_scene.min[a] && p[a] <= k_scene.max[a];
      if (!inside) continue;
      ++tested;
      std::size_t c = 0;
      while (c + 1 < s.count && along > s.cascades[c].end) ++c;
      const Float4 at = in_map(s.cascades[c], p, origin);
      // Within the border of four texels, but for the step to the next whole one.
      const double border = 1 - 2 * 2.9 / k_wish.texels;
      EXPECT_LE(std::max(std::abs(double{at.x}), std::abs(double{at.y})), border);
      EXPECT_LE(std::abs(at.z), 1.0f);
    }
  }
  EXPECT_GT(tested, 2000u);
}

TEST(ShadowCascades, SlicesFollowOneAnotherAndGrow) {
  Random random(2);
  const ShadowCascades s =
      shadow_cascades(make_view(camera_at(random), 1.6, 0.1, 1e5), k_sun, k_scene, {}, k_wish);
  ASSERT_EQ(s.count, 4u);
  EXPECT_FALSE(s.whole);
  EXPECT_EQ(s.cascades[0].begin, 0);
  EXPECT_NEAR(s.cascades[3].end, k_wish.farthest, 1e-9);
  for (std::size_t i = 1; i < s.count; ++i) {
    EXPECT_EQ(s.cascades[i].begin, s.cascades[i - 1].end);
    EXPECT_GT(s.cascades[i].width, s.cascades[i - 1].width);
  }
}

TEST(ShadowCascades, WhateverStandsBetweenASliceAndTheSunMayCast) {
  Random random(3);
  for (int n = 0; n < 100; ++n) {
    const View view = make_view(camera_at(random), 1.6, 0.1, 1e5);
    const ShadowCascades s = shadow_cascades(view, k_sun, k_scene, {}, k_wish);
    for (std::size_t c = 0; c < s.count; ++c) {
      const double along = (s.cascades[c].begin + s.cascades[c].end) / 2;
      const Double3 lit = view.eye - view.frame.back * along;
      if (lit.y < k_scene.min.y || lit.y > k_scene.max.y || std::abs(lit.x) > 2000 || std::abs(lit.z) > 2000)
        continue;
      for (const double up : {0.0, 10.0, 100.0}) {
        const Double3 caster = lit + k_sun * up, half{0.1, 0.1, 0.1};
        if (caster.y > k_scene.max.y) continue;
        EXPECT_NE(classify(s.cascades[c].casters, view.eye, {caster - half, caster + half}),
                  Visibility::outside);
      }
      const Double3 aside = lit + normalized(cross(k_sun, {0, 1, 0})) * (2 * s.cascades[c].width);
      EXPECT_EQ(classify(s.cascades[c].casters, view.eye, {aside, aside}), Visibility::outside);
    }
  }
}

TEST(ShadowCascades, ShadowsStandStillInWholeTexelsWhileTheCameraTurnsAndWalks) {
  Random random(4);
  const Double3 post{3, 2, 5};
  std::array<Float4, 4> before{};
  std::array<double, 4> widths{};
  for (int n = 0; n < 50; ++n) {
    Camera camera = camera_at(random);
    camera.fov = 0.9;
    const ShadowCascades s = shadow_cascades(make_view(camera, 1.6, 0.1, 1e5), k_sun, k_scene, {}, k_wish);
    for (std::size_t c = 0; c < s.count; ++c) {
      const Float4 now = in_map(s.cascades[c], post, {});
      if (n > 0) {
        EXPECT_EQ(s.cascades[c].width, widths[c]);
        const double steps = static_cast<double>(now.x - before[c].x) * k_wish.texels / 2;
        // Of float32 coordinates that are thousands of map widths away.
        EXPECT_NEAR(steps, std::round(steps), 1e-3 * (1 + std::abs(double{now.x})));
      }
      before[c] = now, widths[c] = s.cascades[c].width;
    }
  }
}

TEST(ShadowCascades, ASmallSceneHasOneMapOfAllOfIt) {
  const DoubleBox small{{-3, 0, -3}, {3, 6, 3}};
  const View view = make_view({.eye = {0, 3, 20}, .target = {0, 3, 0}, .fov = 0.6}, 1.6, 0.1, 1000);
  const ShadowCascades s =
      shadow_cascades(view, k_sun, small, {}, {.count = 4, .texels = 512, .nearest = 10, .farthest = 100});
  ASSERT_EQ(s.count, 1u);
  EXPECT_TRUE(s.whole);
  for (int c = 0; c < 8; ++c) {
    const Double3 p{c & 1 ? 3.0 : -3.0, c & 2 ? 6.0 : 0.0, c & 4 ? 3.0 : -3.0};
    const Float4 at = in_map(s.cascades[0], p, {});
    EXPECT_LT(std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)}), 1.0f);
  }
}

}  // namespace
}  // namespace copse
