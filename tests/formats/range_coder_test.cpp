#include "lib/formats/packing/range_coder.h"

#include "lib/formats/random.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(RangeCoder, WhatIsCodedComesBack) {
  Random random(3);
  std::vector<std::uint64_t> numbers{0, 1, 2, 3, (std::uint64_t{1} << 62) - 1, std::uint64_t{1} << 62};
  std::vector<std::int64_t> differences{0, -1, 1, std::int64_t{1} << 40, -(std::int64_t{1} << 40)};
  for (int i = 0; i < 5000; ++i) {
    const double size = random.uniform(0, 40);
    numbers.push_back(static_cast<std::uint64_t>(std::exp2(size)));
    differences.push_back(static_cast<std::int64_t>((random.uniform() < 0.5 ? -1 : 1) * std::exp2(size)));
  }
  const auto code = [&](RangeCoder& c) {
    NumberModel number;
    SignedModel difference;
    BitModel odd;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      ASSERT_EQ(c.number(number, c.decoding() ? 0 : numbers[i]), numbers[i]) << i;
      if (i < differences.size()) {
        ASSERT_EQ(c.signed_number(difference, c.decoding() ? 0 : differences[i]), differences[i]) << i;
      }
      ASSERT_EQ(c.bit(odd, !c.decoding() && (i % 7 == 0)), i % 7 == 0);
      ASSERT_EQ(c.plain(13, c.decoding() ? 0 : i & 0x1fff), i & 0x1fff);
    }
  };
  RangeCoder out;
  code(out);
  const std::vector<std::uint8_t> bytes = out.finish();
  RangeCoder in(bytes);
  code(in);
  EXPECT_TRUE(in.exhausted());
  EXPECT_FALSE(in.failed());
}

TEST(RangeCoder, DifferencesThatCouldOverflowSumsAreNoneThatAnEncoderWrites) {
  RangeCoder out;
  SignedModel model;
  out.signed_number(model, std::int64_t{1} << 41);
  const std::vector<std::uint8_t> bytes = out.finish();
  RangeCoder in(bytes);
  SignedModel again;
  EXPECT_EQ(in.signed_number(again), std::int64_t{1} << 40);
  EXPECT_TRUE(in.failed());
}

TEST(RangeCoder, SkewedBitsCostLittleMoreThanTheirEntropy) {
  Random random(5);
  RangeCoder out;
  BitModel model;
  const int n = 100000;
  const double p = 0.02;
  for (int i = 0; i < n; ++i) out.bit(model, random.uniform() < p);
  const double entropy = -n * (p * std::log2(p) + (1 - p) * std::log2(1 - p)) / 8;
  const auto size = static_cast<double>(out.finish().size());
  EXPECT_LT(size, 1.06 * entropy);
  EXPECT_GT(size, 0.94 * entropy);
}

TEST(RangeCoder, ReadingPastTheEndIsToldAndEnds) {
  RangeCoder out;
  NumberModel write;
  for (std::uint64_t i = 0; i < 100; ++i) out.number(write, i * i);
  std::vector<std::uint8_t> bytes = out.finish();
  bytes.resize(bytes.size() / 2);
  RangeCoder in(bytes);
  NumberModel read;
  for (int i = 0; i < 100; ++i) (void)in.number(read);
  EXPECT_TRUE(in.failed());
  EXPECT_FALSE(in.exhausted());
}

TEST(RangeCoder, EmptyBytesAreNoStream) {
  const RangeCoder in(std::span<const std::uint8_t>{});
  EXPECT_TRUE(in.failed());
}

TEST(RangeCoder, BytesLeftOverAreToldApart) {
  RangeCoder out;
  BitModel model;
  out.bit(model, true);
  std::vector<std::uint8_t> bytes = out.finish();
  bytes.push_back(0);
  RangeCoder in(bytes);
  BitModel again;
  EXPECT_TRUE(in.bit(again));
  EXPECT_FALSE(in.exhausted());
}

}  // namespace
}  // namespace copse
