#include "lib/analysis/lod/leaf_raster.h"

#include "lib/analysis/measure/alpha_raster.h"
#include "lib/formats/random.h"

#include <map>

#include <gtest/gtest.h>

namespace copse {
namespace {

constexpr int k_width = 40, k_height = 24;
using Pixels = std::map<std::size_t, int>;

Pixels drawn(const std::array<Float3, 3>& corners, const AlphaMask* mask = nullptr,
             const std::array<Float2, 3>& uv = {}) {
  Pixels out;
  for_each_leaf_pixel(corners, uv, mask, k_width, k_height, [&](std::size_t p, float) { ++out[p]; });
  return out;
}

std::array<Float3, 3> any_triangle(Random& draw, double size) {
  const double x = draw.uniform(-5, k_width + 5), y = draw.uniform(-5, k_height + 5);
  std::array<Float3, 3> out;
  for (Float3& p : out)
    p = to_float(Double3{x + draw.around(0, size), y + draw.around(0, size), draw.uniform(-1, 1)});
  return out;
}

// How far inside the triangle a pixel's centre is, pixels; below 0 outside.
double inside(const std::array<Float3, 3>& t, std::size_t pixel) {
  const double x = double(pixel % k_width) + 0.5, y = double(pixel / k_width) + 0.5;
  double least = std::numeric_limits<double>::infinity();
  const Double3 a = to_double(t[0]), b = to_double(t[1]), c = to_double(t[2]);
  const double side = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0 ? 1 : -1;
  for (const auto& [p, q] : {std::pair(a, b), {b, c}, {c, a}})
    least = std::min(
        least, side * ((q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x)) / std::hypot(q.x - p.x, q.y - p.y));
  return least;
}

TEST(LeafRaster, DrawsThePixelsWhoseCentresAreInside) {
  const Random root(1);
  for (int i = 0; i < 2000; ++i) {
    Random draw = root.fork(i);
    const auto t = any_triangle(draw, i % 3 == 0 ? 30 : 3);
    const Pixels pixels = drawn(t);
    for (std::size_t p = 0; p < std::size_t{k_width} * k_height; ++p) {
      const double depth = inside(t, p);
      if (std::abs(depth) < 1e-3) continue;
      EXPECT_EQ(pixels.contains(p), depth > 0) << i << " pixel " << p << " inside by " << depth;
    }
  }
}

TEST(LeafRaster, GivesDepthsAndAlphaAsTheOtherRasterDoes) {
  const AlphaMask mask{2, 2, {1, 0, 0, 1}};
  const std::array<Float2, 3> uv{{{0, 0}, {1, 0}, {0.3f, 1}}};
  const Random root(2);
  int differ = 0, same = 0;
  for (int i = 0; i < 300; ++i) {
    Random draw = root.fork(i);
    const auto t = any_triangle(draw, 8);
    ScreenTriangle screen;
    screen.mask = &mask;
    for (int c = 0; c < 3; ++c) screen.corners[c] = {to_double(t[c]), uv[c]};
    std::map<std::size_t, float> depths;
    for_each_sample(
        screen, k_width, k_height, [](std::size_t, float) { return true; },
        [&](std::size_t p, float depth) { depths[p] = depth; });
    for_each_leaf_pixel(t, uv, &mask, k_width, k_height, [&](std::size_t p, float depth) {
      if (!depths.contains(p)) return void(++differ);
      ++same;
      EXPECT_NEAR(depths[p], depth, 1e-3);
      depths.erase(p);
    });
    differ += static_cast<int>(depths.size());
  }
  EXPECT_GT(same, 1000);
  EXPECT_LT(differ, same / 100) << "on edges alone";
}

TEST(LeafRaster, TheHalvesOfACardShareNoPixel) {
  const Random root(3);
  for (int i = 0; i < 500; ++i) {
    Random draw = root.fork(i);
    // Corners on a coarse grid: centres fall on diagonals.
    const auto at = [&] { return static_cast<float>(draw.below(8)) + 4.5f; };
    const Float3 a{at(), at(), 0}, u{at(), at() - 8, 0}, v{at() - 8, at(), 0};
    Pixels both = drawn({a, a + u, a + u + v});
    for (const auto& [p, n] : drawn({a, a + u + v, a + v})) both[p] += n;
    for (const auto& [p, n] : both) EXPECT_EQ(n, 1) << i << " pixel " << p;
  }
}

TEST(LeafRaster, WhatHasNoAreaOrNoPlaceDrawsNothing) {
  constexpr float k_nan = std::numeric_limits<float>::quiet_NaN(), k_far = 3e38f;
  EXPECT_TRUE(drawn({Float3{1, 1, 0}, {5, 5, 0}, {9, 9, 0}}).empty());
  EXPECT_TRUE(drawn({Float3{3, 3, 0}, {3, 3, 0}, {3, 3, 0}}).empty());
  EXPECT_TRUE(drawn({Float3{k_nan, 1, 0}, {5, 2, 0}, {9, 9, 0}}).empty());
  EXPECT_TRUE(drawn({Float3{-k_far, 1, 0}, {k_far, 2, 0}, {9, k_far, 0}}).empty());
  EXPECT_TRUE(drawn({Float3{-9, 1, 0}, {-5, 2, 0}, {-1, 9, 0}}).empty());
  EXPECT_EQ(drawn({Float3{-1e4f, -1e4f, 0}, {1e4f, -1e4f, 0}, {0, 1e5f, 0}}).size(),
            std::size_t{k_width} * k_height);
}

TEST(LeafRaster, AnEyeSeesWhatItsViewDoes) {
  const OrthographicView view{{0, 0, -1}, {0, 1, 0}, {1, 0, 0}, {2, 3, 4}, 0.25, 30, 20};
  const LeafEye eye(view);
  for (const Double3& p : {Double3{0, 0, 0}, {1, -1, 0.5}, {-2, 0.3, 1}}) {
    const Double3 a = view.project(p + view.centre), b = to_double(eye.project(to_float(p)));
    EXPECT_NEAR(distance(a, b), 0, 1e-5);
  }
}

TEST(LeafRaster, ReadsAMaskAsTheMaskDoesWhereverItIsAsked) {
  Random draw(3);
  AlphaMask mask{7, 5, {}};
  for (int i = 0; i < 35; ++i) mask.opaque.push_back(draw.chance(0.5) ? 1 : 0);
  for (int i = 0; i < 4000; ++i) {
    const auto u = static_cast<float>(draw.uniform(-2, 3)), v = static_cast<float>(draw.uniform(-2, 3));
    EXPECT_EQ(leaf_raster::passes(mask, u, v), mask.passes(u, v)) << u << ' ' << v;
  }
  for (const float u : {0.0f, 1.0f, -1.0f, 0.99999994f, 1e-30f, -1e-30f})
    for (const float v : {0.0f, 1.0f, -1.0f, 0.99999994f, 1e-30f, -1e-30f})
      EXPECT_EQ(leaf_raster::passes(mask, u, v), mask.passes(u, v)) << u << ' ' << v;
  EXPECT_TRUE(leaf_raster::passes(AlphaMask{}, 0.5f, 0.5f));
}

TEST(LeafRaster, AsksOnlyForPixelsThatAreWanted) {
  const std::array<Float3, 3> t{{{1, 1, 0}, {30, 2, 0}, {5, 20, 0}}};
  Pixels odd;
  for_each_leaf_pixel(
      t, {}, nullptr, k_width, k_height, [&](std::size_t p, float) { ++odd[p]; },
      [](std::size_t p) { return p % 2 == 1; });
  Pixels all = drawn(t);
  std::erase_if(all, [](const auto& p) { return p.first % 2 == 0; });
  EXPECT_EQ(odd, all);
}

}  // namespace
}  // namespace copse
