#include "lib/analysis/bvh/kd_tree.h"

#include <algorithm>
#include <numeric>

namespace copse {
namespace {

int widest_axis(std::span<const Double3> centres, std::span<const std::uint32_t> items) {
  DoubleBox box;
  for (const std::uint32_t i : items) box.grow(centres[i]);
  const Double3 e = box.extent();
  return e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
}

}  // namespace

BoxTree kd_tree(std::span<const DoubleBox> boxes, std::uint32_t k) {
  const auto items = static_cast<std::uint32_t>(boxes.size());
  std::vector<Double3> centres;
  centres.reserve(items);
  for (const DoubleBox& b : boxes) centres.push_back(b.min * 0.5 + b.max * 0.5);
  std::vector<std::uint32_t> order(items);
  std::iota(order.begin(), order.end(), 0u);

  struct Range {
    std::uint32_t inner, begin, end;
  };
  std::vector<std::vector<std::uint32_t>> inner(1);
  std::vector<Range> open{{0, 0, items}};
  while (!open.empty()) {
    const Range r = open.back();
    open.pop_back();
    const std::span<std::uint32_t> run(order.data() + r.begin, r.end - r.begin);
    if (run.size() <= k) {
      inner[r.inner].assign(run.begin(), run.end());
      continue;
    }
    const int axis = widest_axis(centres, run);
    std::sort(run.begin(), run.end(), [&](std::uint32_t a, std::uint32_t b) {
      return centres[a][axis] != centres[b][axis] ? centres[a][axis] < centres[b][axis] : a < b;
    });
    for (std::uint64_t g = 0; g < k; ++g) {
      const auto begin = r.begin + static_cast<std::uint32_t>(g * run.size() / k);
      const auto end = r.begin + static_cast<std::uint32_t>((g + 1) * run.size() / k);
      const auto child = static_cast<std::uint32_t>(inner.size());
      inner[r.inner].push_back(items + child);
      inner.emplace_back();
      open.push_back({child, begin, end});
    }
  }
  return flatten(inner, items, items);
}

}  // namespace copse
