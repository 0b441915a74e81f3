#include "lib/runtime/skeleton.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace copse {

namespace {

// The hierarchy in one form for both kinds of file: nodes, each with its parent.
struct Nodes {
  std::vector<Float3> centre;
  std::vector<float> diameter;
  std::vector<std::uint32_t> parent;
  std::vector<bool> joint, terminal;
};

Nodes nodes_of_hierarchy(const Tree& tree) {
  Nodes nodes;
  for (const Double3& c : absolute_centres(tree)) nodes.centre.push_back(to_float(c));
  nodes.parent = parents(tree);
  for (const Radius& r : tree.hierarchy.radii) {
    nodes.diameter.push_back(r.diameter);
    nodes.joint.push_back(r.flags & Radius::joint);
    nodes.terminal.push_back(r.flags & Radius::terminal);
  }
  return nodes;
}

// A .tree stores no hierarchy, but its lines say who is whose parent.
Nodes nodes_of_lines(const Tree& tree) {
  Nodes nodes;
  nodes.centre = tree.trunk.line_vertices.to_vector();
  const std::size_t n = nodes.centre.size();
  nodes.diameter.assign(n, 0);
  nodes.parent.assign(n, k_none);
  nodes.joint.assign(n, false);
  nodes.terminal.assign(n, true);
  const auto& lines = tree.trunk.lines;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto [from, to] = lines[i];
    nodes.diameter[from] = std::max(nodes.diameter[from], tree.trunk.diameters[i]);
    nodes.parent[to] = from;
    nodes.terminal[from] = false;
  }
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (nodes.terminal[lines[i][1]]) nodes.diameter[lines[i][1]] = tree.trunk.diameters[i];
  }
  return nodes;
}

// The child that continues each node's branch.
std::vector<std::uint32_t> continuations(const Nodes& nodes) {
  std::vector<std::uint32_t> next(nodes.parent.size(), k_none);
  for (std::uint32_t i = 0; i < nodes.parent.size(); ++i) {
    const std::uint32_t p = nodes.parent[i];
    if (p == k_none || nodes.joint[i]) continue;
    if (next[p] == k_none || nodes.diameter[i] > nodes.diameter[next[p]]) next[p] = i;
  }
  return next;
}

// Levels need the parent's first. A file may list children before parents, so each node walks up to the first
// ancestor that is known and comes back down: every node is settled once. A cycle, which no sound file has,
// ends the walk where it closes.
std::vector<std::uint32_t> levels(const Nodes& nodes) {
  const std::vector<std::uint32_t> next = continuations(nodes);
  std::vector<std::uint32_t> level(nodes.parent.size(), k_none);
  std::vector<std::uint32_t> up;
  for (std::uint32_t start = 0; start < level.size(); ++start) {
    up.clear();
    std::uint32_t at = start;
    while (at != k_none && level[at] == k_none && up.size() < level.size()) {
      up.push_back(at);
      at = nodes.parent[at];
    }
    std::uint32_t below = at == k_none || level[at] == k_none ? 0 : level[at];
    for (auto node = up.rbegin(); node != up.rend(); ++node) {
      const std::uint32_t p = nodes.parent[*node];
      if (p != k_none && next[p] != *node) ++below;
      level[*node] = below;
    }
  }
  return level;
}

void add_trunk(Skeleton& skeleton, const Nodes& nodes) {
  const std::vector<std::uint32_t> level = levels(nodes);
  for (std::uint32_t i = 0; i < nodes.parent.size(); ++i) {
    const std::uint32_t p = nodes.parent[i];
    skeleton.points.push_back({nodes.centre[i], nodes.diameter[i], level[i], p == k_none, nodes.terminal[i]});
    skeleton.levels = std::max(skeleton.levels, level[i] + 1);
    if (p == k_none) continue;
    skeleton.lines.push_back({nodes.centre[p], nodes.centre[i],
                              nodes.joint[i] ? nodes.diameter[i] : nodes.diameter[p], nodes.diameter[i],
                              level[i], nodes.joint[i]});
  }
}

void add_leaves(Skeleton& skeleton, const Tree& tree) {
  const Leaves& leaves = tree.leaves;
  if (leaves.groups.empty()) {
    const float d = std::sqrt(4 * tree.header.mean_leaf_area / std::numbers::pi_v<float>);
    for (const Float3& c : leaves.centres) skeleton.leaves.push_back({c, d, k_none});
  }
  for (std::uint32_t g = 0; g < leaves.groups.size(); ++g) {
    const LeafGroup& group = leaves.groups[g];
    skeleton.groups.push_back({group.centre, group.radius, group.count, {}, false});
    const float d = std::sqrt(4 * group.mean_area / std::numbers::pi_v<float>);
    for (std::uint32_t i = group.first; i < group.first + group.count; ++i) {
      skeleton.leaves.push_back({leaves.centres[leaves.order[i]], d, g});
    }
  }
  const Array<Radius>& radii = tree.hierarchy.radii;
  for (std::size_t r = 0; r < radii.size(); ++r) {
    const std::uint32_t g = radii[r].first_child;
    if (!(radii[r].flags & Radius::terminal) || !radii[r].child_count || g >= skeleton.groups.size())
      continue;
    skeleton.groups[g].terminal = skeleton.points[r].centre;
    skeleton.groups[g].hangs = true;
  }
}

}  // namespace

Skeleton make_skeleton(const Tree& tree) {
  Skeleton skeleton;
  add_trunk(skeleton, tree.hierarchy.radii.empty() ? nodes_of_lines(tree) : nodes_of_hierarchy(tree));
  add_leaves(skeleton, tree);
  return skeleton;
}

}  // namespace copse
