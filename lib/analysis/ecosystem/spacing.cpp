#include "lib/analysis/ecosystem/spacing.h"

#include <algorithm>
#include <cmath>

namespace copse {
namespace {

std::uint64_t key(std::int64_t x, std::int64_t z) {
  return static_cast<std::uint64_t>(x) << 32 ^ (static_cast<std::uint64_t>(z) & 0xffffffffu);
}

std::int64_t bucket(double at, double side) {
  // Where a coordinate is out of the integers' range, one bucket holds all.
  return static_cast<std::int64_t>(std::clamp(std::floor(at / side), -0x1p62, 0x1p62));
}

}  // namespace

bool Spacing::is_free(const Disc& d) const {
  const auto clear_of = [&](const std::vector<Disc>& others) {
    return std::none_of(others.begin(), others.end(), [&](const Disc& other) {
      const double dx = d.x - other.x, dz = d.z - other.z, least = d.radius + other.radius;
      return dx * dx + dz * dz < least * least;
    });
  };
  for (const auto& [exponent, level] : levels_) {
    const double reach = d.radius + level.bucket / 2, side = 2 * reach / level.bucket;
    if (side * side > static_cast<double>(level.buckets.size())) {
      // Among much smaller ones: fewer buckets are filled than lie in reach. Any order gives the same answer.
      for (const auto& [at, discs] : level.buckets)
        if (!clear_of(discs)) return false;
      continue;
    }
    const std::int64_t x1 = bucket(d.x + reach, level.bucket), z1 = bucket(d.z + reach, level.bucket);
    for (std::int64_t z = bucket(d.z - reach, level.bucket); z <= z1; ++z)
      for (std::int64_t x = bucket(d.x - reach, level.bucket); x <= x1; ++x) {
        const auto found = level.buckets.find(key(x, z));
        if (found != level.buckets.end() && !clear_of(found->second)) return false;
      }
  }
  return true;
}

void Spacing::add(const Disc& d) {
  ++count_;
  if (!(d.radius > 0)) return;  // a point overlaps nothing
  int exponent = 0;
  std::frexp(d.radius, &exponent);
  Level& level = levels_[exponent];
  level.bucket = 2 * std::ldexp(1.0, exponent);
  level.buckets[key(bucket(d.x, level.bucket), bucket(d.z, level.bucket))].push_back(d);
}

}  // namespace copse
