#include "lib/analysis/bvh/box_tree.h"

#include <algorithm>
#include <numeric>

namespace copse {

BoxTree flatten(std::span<const std::vector<std::uint32_t>> inner, std::uint32_t items, std::uint32_t root) {
  BoxTree tree;
  struct Open {
    std::uint32_t node, id;
    std::size_t next = 0;
  };
  // A list of one child stands for that child; k_none: nothing is left of it.
  const auto resolved = [&](std::uint32_t id) {
    while (id >= items && inner[id - items].size() == 1) id = inner[id - items][0];
    return id >= items && inner[id - items].empty() ? k_none : id;
  };
  std::vector<Open> open;
  const auto enter = [&](std::uint32_t id) {
    const auto node = static_cast<std::uint32_t>(tree.nodes.size());
    const auto first = static_cast<std::uint32_t>(tree.order.size());
    if (id < items) {
      tree.nodes.push_back({node + 1, id, first, 1});
      tree.order.push_back(id);
    } else {
      tree.nodes.push_back({0, k_none, first, 0});
      open.push_back({node, id});
    }
  };
  if (const std::uint32_t id = resolved(root); id != k_none) enter(id);
  while (!open.empty()) {
    Open& top = open.back();
    const std::vector<std::uint32_t>& children = inner[top.id - items];
    if (top.next < children.size()) {
      const std::uint32_t id = resolved(children[top.next++]);
      if (id != k_none) enter(id);
      continue;
    }
    BoxNode& node = tree.nodes[top.node];
    node.skip = static_cast<std::uint32_t>(tree.nodes.size());
    node.count = static_cast<std::uint32_t>(tree.order.size()) - node.first;
    open.pop_back();
  }
  return tree;
}

BoxTree flat_tree(std::uint32_t items) {
  std::vector<std::vector<std::uint32_t>> inner(1);
  inner[0].resize(items);
  std::iota(inner[0].begin(), inner[0].end(), 0u);
  return flatten(inner, items, items);
}

BoxTree nested_tree(std::span<const std::uint32_t> parents, std::span<const std::uint32_t> group_of) {
  const auto items = static_cast<std::uint32_t>(group_of.size());
  const auto groups = static_cast<std::uint32_t>(parents.size());
  std::vector<std::vector<std::uint32_t>> inner(groups + 1);  // the last is the root
  const auto list_of = [&](std::uint32_t group) -> auto& {
    return inner[group == k_none ? groups : group];
  };
  std::vector<bool> holds(groups);
  for (std::uint32_t i = 0; i < items; ++i) {
    list_of(group_of[i]).push_back(i);
    if (group_of[i] != k_none) holds[group_of[i]] = true;
  }
  for (std::uint32_t g = groups; g-- > 0;) {
    if (holds[g] && parents[g] != k_none) holds[parents[g]] = true;
  }
  for (std::uint32_t g = 0; g < groups; ++g) {
    if (holds[g]) list_of(parents[g]).push_back(items + g);
  }
  return flatten(inner, items, items + groups);
}

std::vector<DoubleBox> node_boxes(const BoxTree& tree, std::span<const DoubleBox> boxes) {
  std::vector<DoubleBox> out(tree.nodes.size());
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    const BoxNode& node = tree.nodes[i];
    if (node.item != k_none) {
      out[i] = boxes[node.item];
      continue;
    }
    for (std::uint32_t c = static_cast<std::uint32_t>(i) + 1; c < node.skip; c = tree.nodes[c].skip) {
      out[i].grow(out[c]);
    }
  }
  return out;
}

std::uint32_t depth(const BoxTree& tree) {
  std::uint32_t deepest = 0;
  std::vector<std::uint32_t> ends;  // of the nodes that are open
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    while (!ends.empty() && ends.back() <= i) ends.pop_back();
    deepest = std::max(deepest, static_cast<std::uint32_t>(ends.size()));
    ends.push_back(tree.nodes[i].skip);
  }
  return deepest;
}

}  // namespace copse
