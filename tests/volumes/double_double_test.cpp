#include "lib/analysis/volumes/double_double.h"

#include "lib/formats/random.h"

#include <CGAL/Exact_rational.h>
#include <gtest/gtest.h>

namespace copse {
namespace {

using Q = CGAL::Exact_rational;

struct Both {
  DoubleDouble number;
  Q exact;
};

Q value(const DoubleDouble& a) {
  return Q(a.high) + Q(a.low);
}

void expect_bounded(const Both& b, int i) {
  const DoubleDouble& n = b.number;
  if (!std::isfinite(n.high) || !std::isfinite(n.low) || !std::isfinite(n.error)) {
    ASSERT_FALSE(sign_of(n).is_certain) << i;
    return;
  }
  const Q off = abs(value(b.number) - b.exact);
  ASSERT_LE(off, Q(b.number.error)) << i;
  const CertainSign s = sign_of(b.number);
  if (s.is_certain) {
    ASSERT_EQ(s.sign, (b.exact > 0) - (b.exact < 0)) << i;
  }
  ASSERT_LE(std::abs(b.number.low), std::abs(b.number.high) * 0x1p-52) << i;
}

Both made(double v) {
  return {{v}, Q(v)};
}
Both sum(const Both& a, const Both& b) {
  return {a.number + b.number, a.exact + b.exact};
}
Both difference(const Both& a, const Both& b) {
  return {a.number - b.number, a.exact - b.exact};
}
Both product(const Both& a, const Both& b) {
  return {a.number * b.number, a.exact * b.exact};
}

// Long chains at all sizes, with numbers that cancel: never farther off than is said.
TEST(DoubleDouble, IsNeverFartherOffThanItKnows) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const int size = i % 5 == 0 ? -480 : i % 5 == 1 ? 200 : 0;
    const auto number = [&] {
      return made(std::ldexp(random.around(0, 1), size + static_cast<int>(random.below(60)) - 30));
    };
    const Both a = number(), b = number(), c = number(), d = number();
    const Both ab = product(a, b), cd = product(c, d), s = sum(ab, cd), t = difference(sum(ab, cd), cd);
    for (const Both& x : {ab, s, t, difference(t, ab), product(s, t), product(product(s, s), a)})
      ASSERT_NO_FATAL_FAILURE(expect_bounded(x, i));
    if (s.exact == 0 || c.exact == 0) continue;
    const Both q{t.number / s.number, t.exact / s.exact};
    if (std::isfinite(q.number.error)) {
      ASSERT_NO_FATAL_FAILURE(expect_bounded(q, i));
      const Both again = difference(product(q, s), t);
      ASSERT_NO_FATAL_FAILURE(expect_bounded(again, i));
      ASSERT_NO_FATAL_FAILURE(expect_bounded({again.number / c.number, again.exact / c.exact}, i));
    }
  }
}

TEST(DoubleDouble, LosesNothingOfProductsOfFloat32Numbers) {
  Random random(2);
  const auto number = [&] {
    return DoubleDouble{static_cast<double>(static_cast<float>(random.around(0, 3)))};
  };
  for (int i = 0; i < 1000; ++i) {
    const DoubleDouble x = number(), y = number(), z = number(), w = number();
    EXPECT_EQ((x * y + z * w).error, 0);
    EXPECT_EQ(((x - y) * z).error, 0);
    EXPECT_EQ(sign_of(x * y - y * x).sign, 0);
    EXPECT_TRUE(sign_of(x * y - y * x).is_certain);
  }
}

TEST(DoubleDouble, WhatOverflowsOrUnderflowsIsNotCertain) {
  const DoubleDouble huge{1e300}, tiny{1e-300};
  EXPECT_FALSE(sign_of(huge * huge).is_certain);
  EXPECT_FALSE(sign_of(huge * huge - huge * huge).is_certain);
  EXPECT_FALSE(sign_of(tiny * tiny).is_certain);
  EXPECT_FALSE(sign_of(DoubleDouble{1} / DoubleDouble{0}).is_certain);
}

}  // namespace
}  // namespace copse
