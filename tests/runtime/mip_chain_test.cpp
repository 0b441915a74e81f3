#include "lib/runtime/mip_chain.h"

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

TEST(MipChain, EveryLevelLetsTheSameShareThrough) {
  // Three texels in ten pass; the mean alpha is 0.36, so plain averages would let nothing through.
  const int n = 128;
  Bytes rgba(static_cast<std::size_t>(n * n) * 4, 100);
  std::mt19937 random(3);
  for (std::size_t i = 0; i < rgba.size(); i += 4) rgba[i + 3] = static_cast<std::uint8_t>(random() % 183);
  const auto chain = mip_chain(rgba, n, n, 0.5f);
  const double expected = alpha_coverage(chain[0], 0.5f);
  EXPECT_NEAR(expected, 0.3, 0.02);
  for (std::size_t level = 1; level + 3 < chain.size(); ++level) {
    EXPECT_NEAR(alpha_coverage(chain[level], 0.5f), expected, 0.03) << "level " << level;
  }
}

TEST(MipChain, AWhollyTransparentTextureStaysSo) {
  const auto chain = mip_chain(Bytes(8 * 8 * 4, 0), 8, 8, 0.5f);
  for (const MipLevel& level : chain) EXPECT_EQ(alpha_coverage(level, 0.5f), 0);
}

}  // namespace
}  // namespace copse
