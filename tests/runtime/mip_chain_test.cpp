#include "lib/runtime/mip_chain.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace copse {
namespace {

using Bytes = std::vector<std::uint8_t>;

TEST(MipChain, EndsAtOneTexelAndHalvesRoundingDown) {
  const auto chain = mip_chain(Bytes(5 * 3 * 4, 255), 5, 3, 0);
  ASSERT_EQ(chain.size(), 3u);
  EXPECT_EQ(chain[1].width, 2);
  EXPECT_EQ(chain[1].height, 1);
  EXPECT_EQ(chain[2].width, 1);
}

TEST(MipChain, AveragesInLinearLight) {
  const auto chain = mip_chain(Bytes{0, 0, 0, 255, 255, 255, 255, 255}, 2, 1, 0);
  EXPECT_EQ(chain[1].rgba, (Bytes{188, 188, 188, 255})) << "half the light is sRGB 188, not 128";
}

TEST(MipChain, WhatIsInvisibleDoesNotTintWhatIsVisible) {
  const auto chain = mip_chain(Bytes{10, 200, 30, 255, 255, 0, 255, 0}, 2, 1, 0);
  EXPECT_EQ(chain[1].rgba, (Bytes{10, 200, 30, 128}));
}

TEST(MipChain, InvisibleTexelsTakeTheColourAroundThem) {
  const auto chain = mip_chain(Bytes{10, 200, 30, 255, 255, 0, 255, 0}, 2, 1, 0.5f);
  EXPECT_EQ(chain[0].rgba, (Bytes{10, 200, 30, 255, 10, 200, 30, 0}));
}

TEST(MipChain, LevelZeroKeepsEveryVisibleByte) {
  Bytes rgba;
  for (int i = 0; i < 256; ++i) {
    const auto b = static_cast<std::uint8_t>(i);
    rgba.insert(rgba.end(), {b, static_cast<std::uint8_t>(255 - i), 7, static_cast<std::uint8_t>(i ? i : 1)});
  }
  EXPECT_EQ(mip_chain(rgba, 16, 16, 0.5f)[0].rgba, rgba);
}

// Random alpha below 183: three texels in ten pass; the mean is 0.36, so plain averages would let nothing
// through.
Bytes noise(int n) {
  Bytes rgba(static_cast<std::size_t>(n * n) * 4, 100);
  std::mt19937 random(3);
  for (std::size_t i = 0; i < rgba.size(); i += 4) rgba[i + 3] = static_cast<std::uint8_t>(random() % 183);
  return rgba;
}

// An opaque leaf of an odd shape amid nothing, with so much of the image's area or somewhat less.
Bytes leaf(int n, double area) {
  Bytes rgba(static_cast<std::size_t>(n * n) * 4, 100);
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const double u = 2 * (x + 0.5) / n - 1, v = 2 * (y + 0.5) / n - 1;
      const double r = std::sqrt(area * 4 / std::numbers::pi) * (1 + 0.3 * std::sin(7 * std::atan2(v, u)));
      rgba[4 * (static_cast<std::size_t>(y) * n + x) + 3] = u * u + v * v <= r * r ? 255 : 0;
    }
  return rgba;
}

TEST(MipChain, EveryLevelLetsTheSameShareThrough) {
  for (const Bytes& rgba : {noise(128), leaf(128, 0.11), leaf(128, 0.5), leaf(128, 0.02)}) {
    const auto chain = mip_chain(rgba, 128, 128, 0.5f);
    const double expected = alpha_coverage(chain[0], 0.5f);
    EXPECT_GT(chain.size(), 3u) << expected;
    for (const MipLevel& level : chain)
      EXPECT_NEAR(alpha_coverage(level, 0.5f), expected, k_coverage_tolerance * expected) << level.width;
  }
}

TEST(MipChain, EndsWhereAFewTexelsCannotHoldTheShare) {
  EXPECT_GT(mip_chain(leaf(128, 0.11), 128, 128, 0.5f).back().width, 1) << "one texel passes or does not";
  EXPECT_EQ(mip_chain(leaf(128, 0.11), 128, 128, 0).back().width, 1) << "nothing is tested";
  EXPECT_EQ(mip_chain(Bytes(64 * 64 * 4, 255), 64, 64, 0.5f).back().width, 1) << "all of it passes";
}

TEST(MipChain, AWhollyTransparentTextureStaysSo) {
  const auto chain = mip_chain(Bytes(8 * 8 * 4, 0), 8, 8, 0.5f);
  for (const MipLevel& level : chain) EXPECT_EQ(alpha_coverage(level, 0.5f), 0);
}

}  // namespace
}  // namespace copse
