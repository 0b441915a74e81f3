#include "lib/formats/random.h"

#include <bit>
#include <cmath>

namespace copse {
namespace {

constexpr std::uint64_t k_golden = 0x9e3779b97f4a7c15u;  // 2^64 / golden ratio, odd

// An odd increment with enough bit changes that successive states differ in many places (ibid., section 5).
std::uint64_t increment_from(std::uint64_t key) {
  const std::uint64_t odd = Random::mix(key + k_golden) | 1u;
  return std::popcount(odd ^ (odd >> 1)) < 24 ? odd ^ 0xaaaaaaaaaaaaaaaau : odd;
}

}  // namespace

Random::Random(std::uint64_t seed) : Random(mix(seed), increment_from(mix(seed))) {}

Random::Random(std::uint64_t state, std::uint64_t increment)
    : key_(state), state_(state), increment_(increment) {}

Random Random::fork(std::uint64_t key) const {
  const std::uint64_t child = mix(mix(key_ + k_golden) ^ mix(key * k_golden + 1));
  return {child, increment_from(child)};
}

std::uint64_t Random::below(std::uint64_t n) {
  // Numbers under 2^64 mod n are thrown away, so that every remainder is equally likely.
  const std::uint64_t unfair = (0 - n) % n;
  std::uint64_t x = next();
  while (x < unfair) x = next();
  return x % n;
}

std::int64_t Random::round(double x) {
  const double floor = std::floor(x);
  return static_cast<std::int64_t>(floor) + (uniform() < x - floor ? 1 : 0);
}

}  // namespace copse
