// Numbers of twice a double's digits that know how far off they can be; 0 where no digit was lost, which is
// so for sums and products of a few float32 numbers.
//
// Source: Dekker 1971 and Knuth's two-sum; the product's rest by fma. Rounding to nearest.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace copse {

struct DoubleDouble {
  double high = 0, low = 0;  // |low| <= half a unit in the last place of high
  double error = 0;          // the exact number is within this of high + low
};

namespace double_double {

// Bounds are sums of a few numbers, rounded too.
inline constexpr double k_slack = 1 + 0x1p-40;
// Below this the rest of a product may underflow, by no more than the tiniest number a few times.
inline constexpr double k_small = 0x1p-900, k_tiny = 0x1p-1060;

struct Pair {
  double sum, rest;  // sum + rest is exact
};
inline Pair two_sum(double a, double b) {
  const double s = a + b, t = s - a;
  return {s, (a - (s - t)) + (b - t)};
}
// Exact where nothing underflows.
inline DoubleDouble product(double a, double b) {
  const double p = a * b, rest = std::fma(a, b, -p);
  const bool is_exact = a == 0 || b == 0 || std::abs(p) >= k_small;
  return {p, rest, is_exact ? 0 : k_tiny};
}

}  // namespace double_double

inline DoubleDouble operator-(const DoubleDouble& a) {
  return {-a.high, -a.low, a.error};
}
inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  using double_double::two_sum;
  const auto high = two_sum(a.high, b.high), low = two_sum(a.low, b.low);
  const auto middle = two_sum(high.rest, low.sum);
  const auto whole = two_sum(high.sum, middle.sum);
  const auto lost = two_sum(low.rest, middle.rest);
  const auto rest = two_sum(whole.rest, lost.sum);
  const auto normal = two_sum(whole.sum, rest.sum);
  const double dropped = std::abs(lost.rest) + std::abs(rest.rest);
  return {normal.sum, normal.rest, (a.error + b.error + dropped) * double_double::k_slack};
}
inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) {
  return a + -b;
}
inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  using double_double::product;
  DoubleDouble p = product(a.high, b.high);
  if (a.low != 0) p = p + product(a.low, b.high);
  if (b.low != 0) p = p + product(a.high, b.low);
  if (a.low != 0 && b.low != 0) p = p + product(a.low, b.low);
  if (a.error != 0 || b.error != 0) {
    const double of_a = 2 * std::abs(a.high), of_b = 2 * std::abs(b.high);  // low is below high
    p.error = (p.error + of_a * b.error + of_b * a.error + a.error * b.error + double_double::k_tiny) *
              double_double::k_slack;
  }
  return p;
}
// a / b, off by what a - q b still is over b.
inline DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
  const double least = std::abs(b.high) * (1 - 0x1p-40) - b.error;
  if (!(least > 0)) return {0, 0, std::numeric_limits<double>::infinity()};
  const double first = a.high / b.high;
  const DoubleDouble left = a - b * DoubleDouble{first};
  const double second = left.high / b.high;
  const DoubleDouble rest = left - b * DoubleDouble{second};
  const auto q = double_double::two_sum(first, second);
  const double error = (std::abs(rest.high) * (1 + 0x1p-40) + rest.error) / least + double_double::k_tiny;
  return {q.sum, q.rest, error * double_double::k_slack};
}

// The sign where it is certain; 0 is certain where no digit was lost.
struct CertainSign {
  bool is_certain;
  int sign;
};
inline CertainSign sign_of(const DoubleDouble& a) {
  if (a.error == 0) return {std::isfinite(a.high), (a.high > 0) - (a.high < 0)};
  if (std::isfinite(a.high) && std::abs(a.high) > 2 * a.error) return {true, a.high > 0 ? 1 : -1};
  return {false, 0};
}

}  // namespace copse
