#include "tools/treeplay/range_owners.h"

#include <algorithm>
#include <numeric>

namespace copse::treeplay {
namespace {

// Which of `count` runs each triangle is in; first(i) is where run i begins.
template <class First>
std::vector<std::uint32_t> runs(std::size_t count, std::size_t triangles, First&& first) {
  std::vector<std::uint32_t> out(triangles, static_cast<std::uint32_t>(count));
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t t = first(i); t < std::min<std::size_t>(first(i + 1), triangles); ++t)
      out[t] = static_cast<std::uint32_t>(i);
  return out;
}

}  // namespace

std::vector<std::uint32_t> leaves_in_order(const Tree& tree) {
  if (tree.leaves.order.size() == tree.leaf_count()) return tree.leaves.order.to_vector();
  std::vector<std::uint32_t> out(tree.leaf_count());
  std::iota(out.begin(), out.end(), 0u);
  return out;
}

std::vector<std::vector<std::uint32_t>> range_owners(const Tree& tree, const std::vector<DrawRange>& ranges) {
  const Trunk& trunk = tree.trunk;
  const Leaves& leaves = tree.leaves;
  const auto segment = runs(tree.segment_count(), trunk.triangles.size(),
                            [&](std::size_t i) { return tree.first_triangle_of_segment(i); });
  const auto leaf = runs(tree.leaf_count(), leaves.triangles.size(),
                         [&](std::size_t i) { return tree.first_triangle_of_leaf(i); });
  const std::vector<std::uint32_t> order = leaves_in_order(tree);
  std::vector<std::uint32_t> place(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) place[order[i]] = i;
  std::vector<std::vector<std::uint32_t>> out;
  for (const DrawRange& range : ranges) {
    std::vector<std::uint32_t>& list = out.emplace_back();
    for (std::size_t t = 0; range.part == DrawPart::trunk && t < segment.size(); ++t) {
      const std::uint32_t m = trunk.materials.empty() ? trunk.material : trunk.materials[t];
      if (m == range.material) list.push_back(segment[t]);
    }
    for (std::size_t t = 0; range.part == DrawPart::leaves && t < leaf.size(); ++t) {
      const std::uint32_t m = leaves.materials.empty() ? leaves.material : leaves.materials[leaf[t]];
      if (m == range.material) list.push_back(place[leaf[t]]);
    }
    std::sort(list.begin(), list.end());
  }
  return out;
}

}  // namespace copse::treeplay
