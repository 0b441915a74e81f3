#include "lib/analysis/surface/spatial_order.h"

#include "lib/analysis/surface/tolerances.h"

#include <algorithm>

namespace copse {
namespace {

constexpr std::uint32_t k_bits = 6;  // of a cell along an axis: a counter a cell stays in the cache

DoubleBox box_of(std::span<const Double3> positions, std::span<const std::uint32_t> at) {
  DoubleBox box;
  for (const std::uint32_t v : at) box.grow(positions[v]);
  return box;
}

// The bits of x with two others' places between them.
constexpr std::uint32_t spread(std::uint32_t x) {
  std::uint32_t out = 0;
  for (std::uint32_t bit = 0; bit < k_bits; ++bit) out |= (x >> bit & 1) << 3 * bit;
  return out;
}

std::uint32_t place(double x, double low, double scale) {
  const double cell = (x - low) * scale;
  if (!(cell > 0)) return 0;
  return static_cast<std::uint32_t>(std::min(cell, static_cast<double>((1u << k_bits) - 1)));
}

}  // namespace

bool is_scattered(std::span<const Double3> positions, std::span<const std::uint32_t> at) {
  if (at.size() < k_least_scattered) return false;
  double way = 0;
  for (std::size_t i = 1; i < at.size(); ++i) way += distance(positions[at[i - 1]], positions[at[i]]);
  return way > k_scattered * static_cast<double>(at.size()) * length(box_of(positions, at).extent());
}

std::vector<std::uint32_t> spatial_order(std::span<const Double3> positions,
                                         std::span<const std::uint32_t> at) {
  const DoubleBox box = box_of(positions, at);
  const Double3 e = box.extent();
  const double longest = std::max({e.x, e.y, e.z});
  const double scale = longest > 0 ? static_cast<double>(1u << k_bits) / longest : 0;
  std::vector<std::uint32_t> cell;
  cell.reserve(at.size());
  for (const std::uint32_t v : at) {
    const Double3& p = positions[v];
    cell.push_back(spread(place(p.x, box.min.x, scale)) | spread(place(p.y, box.min.y, scale)) << 1 |
                   spread(place(p.z, box.min.z, scale)) << 2);
  }
  std::vector<std::uint32_t> next((std::size_t{1} << 3 * k_bits) + 1, 0);
  for (const std::uint32_t c : cell) ++next[c + 1];
  for (std::size_t c = 0; c + 1 < next.size(); ++c) next[c + 1] += next[c];
  std::vector<std::uint32_t> order(at.size());
  for (std::uint32_t i = 0; i < at.size(); ++i) order[next[cell[i]]++] = i;
  return order;
}

}  // namespace copse
