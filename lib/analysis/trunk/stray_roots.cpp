#include "lib/analysis/trunk/stray_roots.h"

#include <algorithm>

namespace copse {
namespace {

struct Standing {
  std::uint32_t root = k_none;
  std::size_t radii = 0;
  DoubleBox box;
};

// The trees, by the lesser x of their boxes.
std::vector<Standing> standing_trees(const Hierarchy& hierarchy) {
  std::vector<Standing> trees;
  std::vector<std::uint32_t> tree(hierarchy.radii.size());
  for (std::uint32_t r = 0; r < hierarchy.radii.size(); ++r) {
    const RadiusNode& node = hierarchy.radii[r];
    tree[r] = node.parent == k_none ? static_cast<std::uint32_t>(trees.size()) : tree[node.parent];
    if (node.parent == k_none) trees.push_back({.root = r, .radii = 0, .box = {}});
    ++trees[tree[r]].radii;
    trees[tree[r]].box.grow(node.centre);
  }
  std::ranges::stable_sort(trees, {}, [](const Standing& t) { return t.box.min.x; });
  return trees;
}

bool holds_up(const Standing& tree, double ground, const Double3& base) {
  const DoubleBox& b = tree.box;
  return base.x >= b.min.x && base.x <= b.max.x && base.z >= b.min.z && base.z <= b.max.z &&
         base.y <= b.max.y && base.y - ground > k_above_ground * (b.max.y - b.min.y);
}

}  // namespace

std::vector<std::uint32_t> stray_roots(const Hierarchy& hierarchy) {
  const std::vector<Standing> trees = standing_trees(hierarchy);
  // Up to each, the farthest x that any reaches: nothing before the last that falls short is of interest.
  std::vector<double> reached;
  for (const Standing& t : trees)
    reached.push_back(std::max(t.box.max.x, reached.empty() ? t.box.max.x : reached.back()));
  std::vector<std::uint32_t> stray;
  for (const Standing& small : trees) {
    const Double3& base = hierarchy.radii[small.root].centre;
    auto i = static_cast<std::size_t>(
        std::ranges::upper_bound(trees, base.x, {}, [](const Standing& t) { return t.box.min.x; }) -
        trees.begin());
    for (; i-- > 0 && reached[i] >= base.x;) {
      const Standing& large = trees[i];
      if (static_cast<double>(small.radii) > k_small_tree * static_cast<double>(large.radii)) continue;
      if (!holds_up(large, hierarchy.radii[large.root].centre.y, base)) continue;
      stray.push_back(small.root);
      break;
    }
  }
  std::ranges::sort(stray);
  return stray;
}

}  // namespace copse
