#include "lib/analysis/surface/bands.h"

#include "lib/formats/material.h"

#include <numbers>

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(RingCircle, IsTheMeanOfTheVerticesAndOfTheirDistances) {
  std::vector<Double3> p;
  for (int i = 0; i < 5; ++i) {
    const double a = 2 * std::numbers::pi * i / 5;
    p.push_back({1e7 + 3 * std::cos(a), 2, 1e7 + 3 * std::sin(a)});
  }
  const std::vector<std::uint32_t> ring{0, 1, 2, 3, 4};
  const RingCircle c = ring_circle(p, ring);
  EXPECT_LT(distance(c.centre, {1e7, 2, 1e7}), 1e-8);
  EXPECT_NEAR(c.radius, 3, 1e-8);
  EXPECT_EQ(ring_circle(p, {}).radius, 0);
}

TEST(Bands, ClaimTheirTrianglesAndForgetStandIns) {
  Bands bands;
  bands.band_of.assign(4, k_none);
  const std::vector<std::uint32_t> from{0, 1, 2}, to{3}, of{1, 3, 17};
  bands.add(from, to, of);
  EXPECT_EQ(bands.count(), 1u);
  EXPECT_EQ(bands.band_of, (std::vector<std::uint32_t>{k_none, 0, k_none, 0}));
  EXPECT_EQ(bands.triangles, (std::vector<std::uint32_t>{1, 3}));
  EXPECT_EQ(bands.ring(0).size(), 3u);
  EXPECT_EQ(bands.ring(1).size(), 1u);
}

}  // namespace
}  // namespace copse
