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

std::size_t Spacing::Level::slot_of(std::uint64_t key) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = static_cast<std::size_t>((key * 0x9e3779b97f4a7c15u) >> 32) & mask;
  while (slots_[at].first != k_end && slots_[at].key != key) at = (at + 1) & mask;
  return at;
}

void Spacing::Level::grow() {
  std::vector<Slot> before(2 * slots_.size());
  before.swap(slots_);
  for (const Slot& s : before)
    if (s.first != k_end) slots_[slot_of(s.key)] = s;
}

void Spacing::Level::add(const Disc& disc, std::uint64_t key) {
  if (2 * filled_ >= slots_.size()) grow();
  Slot& slot = slots_[slot_of(key)];
  filled_ += slot.first == k_end;
  links_.push_back({disc, slot.first});
  slot = {key, static_cast<std::uint32_t>(links_.size() - 1)};
}

template <class Test>
bool Spacing::Level::any_in(std::uint64_t key, const Test& test) const {
  for (std::uint32_t i = slots_[slot_of(key)].first; i != k_end; i = links_[i].next)
    if (test(links_[i].disc)) return true;
  return false;
}

template <class Test>
bool Spacing::Level::any(const Test& test) const {
  return std::any_of(links_.begin(), links_.end(), [&](const Link& l) { return test(l.disc); });
}

template <class Test>
bool Spacing::any_near(double x, double z, double radius, const Test& test) const {
  for (const auto& [exponent, level] : levels_) {
    const double reach = radius + level.side / 2, side = 2 * reach / level.side;
    if (side * side > static_cast<double>(level.buckets())) {
      // Among much smaller ones: fewer buckets are filled than lie in reach.
      if (level.any(test)) return true;
      continue;
    }
    // What is in the way is mostly near: its own bucket first.
    const std::int64_t own_x = bucket(x, level.side), own_z = bucket(z, level.side);
    if (level.any_in(key(own_x, own_z), test)) return true;
    const std::int64_t x1 = bucket(x + reach, level.side), z1 = bucket(z + reach, level.side);
    for (std::int64_t r = bucket(z - reach, level.side); r <= z1; ++r)
      for (std::int64_t c = bucket(x - reach, level.side); c <= x1; ++c)
        if ((c != own_x || r != own_z) && level.any_in(key(c, r), test)) return true;
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

bool Spacing::closes(const Patch& p, double radius, std::size_t most, std::vector<Disc>& near) const {
  const double half_x = p.width / 2, half_z = p.depth / 2, x = p.x + half_x, z = p.z + half_z;
  const std::size_t before = near.size();
  return any_near(x, z, radius + std::max(half_x, half_z), [&](const Disc& other) {
    const double dx = std::abs(x - other.x), dz = std::abs(z - other.z), least = radius + other.radius;
    const double far_x = dx + half_x, far_z = dz + half_z;
    if (far_x * far_x + far_z * far_z < least * least) return true;
    const double near_x = std::max(dx - half_x, 0.0), near_z = std::max(dz - half_z, 0.0);
    if (near_x * near_x + near_z * near_z < least * least && near.size() - before <= most)
      near.push_back(other);
    return false;
  });
}

void Spacing::add(const Disc& d) {
  ++count_;
  if (!(d.radius > 0)) return;  // a point overlaps nothing
  int exponent = 0;
  std::frexp(d.radius, &exponent);
  Level& level = levels_.try_emplace(exponent, std::ldexp(2.0, exponent)).first->second;
  level.add(d, key(bucket(d.x, level.side), bucket(d.z, level.side)));
}

}  // namespace copse
