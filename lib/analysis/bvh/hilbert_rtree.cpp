#include "lib/analysis/bvh/hilbert_rtree.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace copse {
namespace {

constexpr int k_bits = 21;

// One cube round all centres, so that the curve is not stretched.
class Grid {
 public:
  explicit Grid(std::span<const Double3> points) {
    DoubleBox box;
    for (const Double3& p : points) box.grow(p);
    if (box.empty()) return;
    origin_ = box.min;
    const Double3 half = box.max * 0.5 - box.min * 0.5;
    half_size_ = std::max({half.x, half.y, half.z});
  }
  std::uint64_t index(const Double3& p) const {
    std::array<std::uint32_t, 3> cell{};
    if (half_size_ > 0) {
      constexpr double k_last = (1 << k_bits) - 1;
      for (int i = 0; i < 3; ++i) {
        const double t = (p[i] * 0.5 - origin_[i] * 0.5) / half_size_;
        cell[i] = static_cast<std::uint32_t>(std::clamp(t * (k_last + 1), 0.0, k_last));
      }
    }
    return hilbert_index(cell, k_bits);
  }

 private:
  Double3 origin_;
  double half_size_ = 0;
};

std::vector<std::uint32_t> order_in(const Grid& grid, std::span<const Double3> points) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys;
  keys.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) keys.emplace_back(grid.index(points[i]), i);
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> order;
  order.reserve(keys.size());
  for (const auto& [key, i] : keys) order.push_back(i);
  return order;
}

std::vector<Double3> centres_of(std::span<const DoubleBox> boxes) {
  std::vector<Double3> centres;
  centres.reserve(boxes.size());
  for (const DoubleBox& b : boxes) centres.push_back(b.min * 0.5 + b.max * 0.5);
  return centres;
}

}  // namespace

std::uint64_t hilbert_index(std::array<std::uint32_t, 3> x, int bits) {
  // Undo the rotations and reflections of the cubes from the largest to the smallest.
  for (std::uint32_t q = 1u << (bits - 1); q > 1; q >>= 1) {
    const std::uint32_t low = q - 1;
    for (int i = 0; i < 3; ++i) {
      if ((x[i] & q) != 0) {
        x[0] ^= low;
      } else {
        const std::uint32_t t = (x[0] ^ x[i]) & low;
        x[0] ^= t, x[i] ^= t;
      }
    }
  }
  // Gray code to binary, over the transposed bits.
  x[1] ^= x[0], x[2] ^= x[1];
  std::uint32_t t = 0;
  for (std::uint32_t q = 1u << (bits - 1); q > 1; q >>= 1) {
    if ((x[2] & q) != 0) t ^= q - 1;
  }
  for (std::uint32_t& c : x) c ^= t;
  std::uint64_t index = 0;
  for (int b = bits - 1; b >= 0; --b) {
    for (int i = 0; i < 3; ++i) index = index << 1 | (x[i] >> b & 1);
  }
  return index;
}

std::vector<std::uint32_t> hilbert_order(std::span<const Double3> points) {
  return order_in(Grid(points), points);
}

BoxTree hilbert_rtree(std::span<const DoubleBox> boxes, std::uint32_t k) {
  const auto items = static_cast<std::uint32_t>(boxes.size());
  std::vector<std::vector<std::uint32_t>> inner;
  std::vector<std::uint32_t> ids(items);
  std::iota(ids.begin(), ids.end(), 0u);
  std::vector<DoubleBox> level(boxes.begin(), boxes.end());
  std::vector<Double3> centres = centres_of(level);
  const Grid grid(centres);
  while (ids.size() > 1) {
    const std::vector<std::uint32_t> order = order_in(grid, centres);
    std::vector<std::uint32_t> next_ids;
    std::vector<DoubleBox> next_level;
    for (std::size_t begin = 0; begin < order.size(); begin += k) {
      DoubleBox box;
      std::vector<std::uint32_t> children;
      for (std::size_t i = begin; i < std::min<std::size_t>(begin + k, order.size()); ++i) {
        children.push_back(ids[order[i]]);
        box.grow(level[order[i]]);
      }
      next_ids.push_back(items + static_cast<std::uint32_t>(inner.size()));
      next_level.push_back(box);
      inner.push_back(std::move(children));
    }
    ids = std::move(next_ids), level = std::move(next_level);
    centres = centres_of(level);
  }
  return ids.empty() ? BoxTree() : flatten(inner, items, ids[0]);
}

}  // namespace copse
