#include "lib/formats/import/exact_weld.h"

#include "lib/formats/material.h"

#include <bit>
#include <random>

namespace copse {
namespace {

// The upper and lower half of a 128-bit product, folded: every bit of both factors reaches every bit.
std::uint64_t fold(std::uint64_t a, std::uint64_t b) {
  __extension__ using Wide = unsigned __int128;
  const Wide product = static_cast<Wide>(a) * b;
  return static_cast<std::uint64_t>(product) ^ static_cast<std::uint64_t>(product >> 64);
}

}  // namespace

ExactWeld::ExactWeld(std::vector<Double3>& points)
    : points_(points),
      slots_(1024, k_none),
      seed_((std::uint64_t{std::random_device{}()} << 32) | 0x9e3779b9u) {}

std::uint64_t ExactWeld::hash(const Double3& p) const {
  std::uint64_t h = fold(std::bit_cast<std::uint64_t>(p.x) ^ seed_, 0xa0761d6478bd642full);
  h = fold(std::bit_cast<std::uint64_t>(p.y) ^ h, 0xe7037ed1a0b428dbull ^ seed_);
  return fold(std::bit_cast<std::uint64_t>(p.z) ^ h, 0x8ebc6af09c88c6e3ull ^ seed_);
}

std::uint32_t ExactWeld::index_of(Double3 point) {
  point += {0, 0, 0};  // -0 becomes 0
  const std::uint64_t mask = slots_.size() - 1;
  std::uint64_t at = hash(point) & mask;
  for (; slots_[at] != k_none; at = (at + 1) & mask) {
    if (points_[slots_[at]] == point) return slots_[at];
  }
  const auto index = static_cast<std::uint32_t>(points_.size());
  slots_[at] = index;
  points_.push_back(point);
  if (points_.size() * 2 > slots_.size()) grow();
  return index;
}

void ExactWeld::grow() {
  std::vector<std::uint32_t> larger(slots_.size() * 4, k_none);
  const std::uint64_t mask = larger.size() - 1;
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    std::uint64_t at = hash(points_[i]) & mask;
    while (larger[at] != k_none) at = (at + 1) & mask;
    larger[at] = i;
  }
  slots_ = std::move(larger);
}

}  // namespace copse
