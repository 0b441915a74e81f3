#include "lib/analysis/ecosystem/spacing.h"

#include <cmath>

namespace copse {
namespace {

std::uint64_t key(std::int64_t x, std::int64_t z) {
  return static_cast<std::uint64_t>(x) << 32 ^ (static_cast<std::uint64_t>(z) & 0xffffffffu);
}

std::int64_t bucket(double at, double side) {
  return static_cast<std::int64_t>(std::floor(at / side));
}

}  // namespace

bool Spacing::is_free(const Disc& d) const {
  for (const auto& [exponent, level] : levels_) {
    const double reach = d.radius + level.bucket / 2;
    const std::int64_t x1 = bucket(d.x + reach, level.bucket), z1 = bucket(d.z + reach, level.bucket);
    for (std::int64_t z = bucket(d.z - reach, level.bucket); z <= z1; ++z)
      for (std::int64_t x = bucket(d.x - reach, level.bucket); x <= x1; ++x) {
        const auto found = level.buckets.find(key(x, z));
        if (found == level.buckets.end()) continue;
        for (const Disc& other : found->second) {
          const double dx = d.x - other.x, dz = d.z - other.z, least = d.radius + other.radius;
          if (dx * dx + dz * dz < least * least) return false;
        }
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
