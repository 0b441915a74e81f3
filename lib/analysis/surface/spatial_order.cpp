#include "lib/analysis/surface/spatial_order.h"

#include "lib/analysis/surface/tolerances.h"

#include <algorithm>
#include <utility>

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

// `elements` (none, or one an entry of `order`) in that order.
template <class T>
void permute(std::vector<T>& elements, std::span<const std::uint32_t> order) {
  if (elements.empty()) return;
  std::vector<T> out;
  out.reserve(order.size());
  for (const std::uint32_t i : order) out.push_back(elements[i]);
  elements = std::move(out);
}

// Renumbers what corners name by first use.
template <class T>
void number_by_use(std::vector<T>& elements, std::vector<Triangle>& corners) {
  std::vector<std::uint32_t> number(elements.size(), k_none), order;
  order.reserve(elements.size());
  const auto use = [&](std::uint32_t i) {
    if (number[i] != k_none) return;
    number[i] = static_cast<std::uint32_t>(order.size());
    order.push_back(i);
  };
  for (Triangle& t : corners) {
    for (std::uint32_t& i : t) {
      if (i == k_none) continue;
      use(i);
      i = number[i];
    }
  }
  for (std::uint32_t i = 0; i < number.size(); ++i) use(i);
  permute(elements, order);
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

std::vector<std::uint32_t> order_by_place(Mesh& mesh) {
  std::vector<std::uint32_t> order;
  {
    std::vector<std::uint32_t> first;
    first.reserve(mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) first.push_back(t[0]);
    if (!is_scattered(mesh.positions, first)) return {};
    order = spatial_order(mesh.positions, first);
  }
  permute(mesh.triangles, order);
  permute(mesh.normal_triangles, order);
  permute(mesh.texcoord_triangles, order);
  permute(mesh.part_of, order);
  permute(mesh.face_of, order);
  number_by_use(mesh.positions, mesh.triangles);
  number_by_use(mesh.normals, mesh.normal_triangles);
  number_by_use(mesh.texcoords, mesh.texcoord_triangles);
  return order;
}

}  // namespace copse
