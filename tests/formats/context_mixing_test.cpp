#include "lib/formats/packing/context_mixing.h"

#include "lib/formats/random.h"

#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

// The size in bytes of numbers as `code` writes them.
template <class Code>
double size_of(const Code& code) {
  RangeCoder out;
  code(out);
  return static_cast<double>(out.finish().size());
}

TEST(ContextMixing, WhatIsCodedComesBack) {
  Random random(4);
  std::vector<std::uint64_t> numbers{0, 1, 2, (std::uint64_t{1} << 62) - 1, std::uint64_t{1} << 62};
  std::vector<std::int64_t> differences{0, -1, 1, std::int64_t{1} << 40, -(std::int64_t{1} << 40)};
  while (numbers.size() < 5000) {
    const double size = random.uniform(0, 39);
    numbers.push_back(static_cast<std::uint64_t>(std::exp2(size)));
    differences.push_back(static_cast<std::int64_t>((random.uniform() < 0.5 ? -1 : 1) * std::exp2(size)));
  }
  const auto code = [&](RangeCoder& c) {
    MixedNumber number{3, 100, 1};
    MixedSigned difference{2, 7, 5, 3};
    MixedBit odd{1, 4};
    MixedSymbol symbol{20, {3, 1}};
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      ASSERT_EQ(number.code(c, {i % 3, i % 200, 0}, c.decoding() ? 0 : numbers[i]), numbers[i]) << i;
      ASSERT_EQ(difference.code(c, {i % 2, i % 7, i % 5, i % 3}, c.decoding() ? 0 : differences[i]),
                differences[i])
          << i;
      ASSERT_EQ(symbol.code(c, {i % 3, 0}, c.decoding() ? 0 : i % 20), i % 20);
      ASSERT_EQ(odd.code(c, {0, i % 4}, !c.decoding() && i % 7 == 0), i % 7 == 0);
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

TEST(ContextMixing, AKnownStreamHasKnownBytes) {
  RangeCoder out;
  MixedSigned m{2, 3};
  for (std::int64_t i = 0; i < 24; ++i)
    m.code(out, {static_cast<std::size_t>(i % 2), 0}, i % 5 - 2 + i % 2 * 100);
  EXPECT_EQ(out.finish(), (std::vector<std::uint8_t>{9, 103, 152, 206, 194, 254, 214, 252, 235, 154, 48, 124,
                                                     189, 120, 103, 17, 215}));
}

TEST(ContextMixing, TheContextThatTellsIsFoundAmongThoseThatDoNot) {
  Random random(7);
  std::vector<std::int64_t> values;
  std::vector<std::size_t> tells, tells_not;
  for (int i = 0; i < 4000; ++i) {
    tells.push_back(random.below(6)), tells_not.push_back(random.below(6));
    const double size = std::exp2(2.0 * static_cast<double>(tells.back()));
    values.push_back(std::llround(random.uniform(-size, size)));
  }
  const auto mixed = [&](RangeCoder& c) {
    MixedSigned m{6, 6, 1};
    for (std::size_t i = 0; i < values.size(); ++i) m.code(c, {tells_not[i], tells[i], 0}, values[i]);
  };
  const auto right = [&](RangeCoder& c) {
    std::array<SignedModel, 6> m;
    for (std::size_t i = 0; i < values.size(); ++i) c.signed_number(m[tells[i]], values[i]);
  };
  const auto wrong = [&](RangeCoder& c) {
    std::array<SignedModel, 6> m;
    for (std::size_t i = 0; i < values.size(); ++i) c.signed_number(m[tells_not[i]], values[i]);
  };
  EXPECT_LT(size_of(mixed), 1.03 * size_of(right));
  EXPECT_LT(size_of(mixed), 0.85 * size_of(wrong));
}

TEST(ContextMixing, ContextsBeyondTheLastAreTheLast) {
  const auto code = [](std::size_t context) {
    return [=](RangeCoder& c) {
      MixedNumber m{4};
      for (std::uint64_t i = 0; i < 100; ++i) m.code(c, {context}, i % 3);
    };
  };
  EXPECT_EQ(size_of(code(3)), size_of(code(77)));
}

TEST(ContextMixing, DifferencesThatCouldOverflowSumsAreNoneThatAnEncoderWrites) {
  RangeCoder out;
  MixedSigned model{1};
  model.code(out, {0}, std::int64_t{1} << 41);
  const std::vector<std::uint8_t> bytes = out.finish();
  RangeCoder in(bytes);
  MixedSigned again{1};
  EXPECT_EQ(again.code(in, {0}), std::int64_t{1} << 40);
  EXPECT_TRUE(in.failed());
}

TEST(ContextMixing, WhatEachStreamTakesAddsUpToTheBytes) {
  Random random(9);
  RangeCoder out;
  MixedNumber a{1};
  MixedSigned b{1};
  for (int i = 0; i < 1000; ++i) {
    out.stream("a");
    a.code(out, {0}, random.below(100));
    out.stream("b");
    b.code(out, {0}, static_cast<std::int64_t>(random.below(9)) - 4);
  }
  ASSERT_EQ(out.costs().size(), 2u);
  EXPECT_EQ(out.costs()[0].values, 1000u);
  EXPECT_GT(out.costs()[0].bits, out.costs()[1].bits);
  const double told = (out.costs()[0].bits + out.costs()[1].bits) / 8;
  EXPECT_NEAR(told, static_cast<double>(out.finish().size()), 6);
}

}  // namespace
}  // namespace copse
