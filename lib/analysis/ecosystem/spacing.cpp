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

template <class Test>
bool Spacing::any_near(double x, double z, double radius, const Test& test) const {
  for (const auto& [exponent, level] : levels_) {
    const double reach = radius + level.bucket / 2, side = 2 * reach / level.bucket;
    if (side * side > static_cast<double>(level.buckets.size())) {
      // Among much smaller ones: fewer buckets are filled than lie in reach. Any order gives the same answer.
      for (const auto& [at, discs] : level.buckets)
        if (std::any_of(discs.begin(), discs.end(), test)) return true;
      continue;
    }
    const auto in_bucket = [&](std::int64_t c, std::int64_t r) {
      const auto found = level.buckets.find(key(c, r));
      return found != level.buckets.end() && std::any_of(found->second.begin(), found->second.end(), test);
    };
    // What is in the way is mostly near: its own bucket first.
    const std::int64_t own_x = bucket(x, level.bucket), own_z = bucket(z, level.bucket);
    if (in_bucket(own_x, own_z)) return true;
    const std::int64_t x1 = bucket(x + reach, level.bucket), z1 = bucket(z + reach, level.bucket);
    for (std::int64_t r = bucket(z - reach, level.bucket); r <= z1; ++r)
      for (std::int64_t c = bucket(x - reach, level.bucket); c <= x1; ++c)
        if ((c != own_x || r != own_z) && in_bucket(c, r)) return true;
  }
  return false;
}

bool Spacing::is_free(const Disc& d) const {
  return !any_near(d.x, d.z, d.radius, [&](const Disc& other) {
    const double dx = d.x - other.x, dz = d.z - other.z, least = d.radius + other.radius;
    return dx * dx + dz * dz < least * least;
  });
}

double Spacing::clearance(double x, double z, double most) const {
  double clear = most;
  any_near(x, z, most, [&](const Disc& other) {
    const double dx = x - other.x, dz = z - other.z;
    clear = std::min(clear, std::sqrt(dx * dx + dz * dz) - other.radius);
    return false;
  });
  return clear;
}

bool Spacing::closes(const Patch& p, double radius) const {
  const double x = p.x + p.width / 2, z = p.z + p.depth / 2;
  return any_near(x, z, radius, [&](const Disc& other) {
    const double dx = std::abs(x - other.x) + p.width / 2, dz = std::abs(z - other.z) + p.depth / 2,
                 least = radius + other.radius;
    return dx * dx + dz * dz < least * least;
  });
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
