#include "lib/analysis/leaves/group_hierarchy.h"

#include "lib/analysis/round/minimal_sphere.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>

namespace copse {
namespace {

using Indices = std::vector<std::uint32_t>;

// A tree while it is built: parents before children.
struct Node {
  std::uint32_t parent = k_none;
  std::uint32_t group = k_none;  // bottom nodes
  StoredSphere sphere;
};

// --- splitting -------------------------------------------------------------------------------------------

class Splitter {
 public:
  explicit Splitter(std::span<const LeafGroup> groups) : groups_(groups), right_(groups.size()) {}

  // Orders `set` so that the first part is [0, answer).
  std::size_t median(std::span<std::uint32_t> set) const {
    DoubleBox box;
    for (const std::uint32_t g : set) box.grow(to_double(groups_[g].centre));
    const Double3 e = box.extent();
    sort_along(e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2, set);
    return set.size() / 2;
  }

  std::size_t sweep(std::span<std::uint32_t> set) {
    double best = std::numeric_limits<double>::infinity();
    std::size_t split = set.size() / 2;
    int best_axis = 0;
    for (int axis = 0; axis < 3; ++axis) {
      sort_along(axis, set);
      DoubleBox box;
      for (std::size_t i = set.size(); i-- > 1;) {
        grow(box, set[i]);
        right_[i] = surface(box) * static_cast<double>(set.size() - i);
      }
      box = {};
      for (std::size_t i = 1; i < set.size(); ++i) {
        grow(box, set[i - 1]);
        const double cost = surface(box) * static_cast<double>(i) + right_[i];
        if (cost < best) best = cost, split = i, best_axis = axis;
      }
    }
    if (best_axis != 2) sort_along(best_axis, set);
    return split;
  }

 private:
  void sort_along(int axis, std::span<std::uint32_t> set) const {
    std::sort(set.begin(), set.end(), [&](std::uint32_t a, std::uint32_t b) {
      const float x = groups_[a].centre[axis], y = groups_[b].centre[axis];
      return x != y ? x < y : a < b;
    });
  }
  void grow(DoubleBox& box, std::uint32_t group) const {
    const Double3 c = to_double(groups_[group].centre);
    const double r = groups_[group].radius;
    box.grow(c - Double3{r, r, r}), box.grow(c + Double3{r, r, r});
  }
  static double surface(const DoubleBox& box) {  // of the sphere round the box, but for a factor
    const Double3 e = box.extent();
    return dot(e, e);
  }

  std::span<const LeafGroup> groups_;
  std::vector<double> right_;
};

std::vector<Node> build(std::span<const LeafGroup> groups, GroupBuilder builder) {
  struct Open {
    std::span<std::uint32_t> set;
    std::uint32_t parent;
    int depth;
  };
  Indices order(groups.size());
  std::iota(order.begin(), order.end(), 0u);
  // Lopsided splits are good for clusters, but not without end.
  const int deepest = 2 * std::bit_width(groups.size()) + 4;
  Splitter splitter(groups);
  std::vector<Node> nodes;
  std::vector<Open> open{{order, k_none, 0}};
  while (!open.empty()) {
    const Open top = open.back();
    open.pop_back();
    const auto here = static_cast<std::uint32_t>(nodes.size());
    nodes.push_back({top.parent, top.set.size() == 1 ? top.set[0] : k_none, {}});
    if (top.set.size() == 1) continue;
    const bool halve = builder == GroupBuilder::median || top.depth > deepest;
    const std::size_t split = halve ? splitter.median(top.set) : splitter.sweep(top.set);
    open.push_back({top.set.subspan(split), here, top.depth + 1});
    open.push_back({top.set.first(split), here, top.depth + 1});
  }
  return nodes;
}

// --- spheres ---------------------------------------------------------------------------------------------

// The children of every node, in order: list[first[n] .. first[n + 1]).
struct Children {
  Indices first, list;
  explicit Children(const std::vector<Node>& nodes) : first(nodes.size() + 1, 0) {
    for (const Node& n : nodes) {
      if (n.parent != k_none) ++first[n.parent];
    }
    std::uint32_t sum = 0;
    for (std::uint32_t& n : first) n = sum += n;
    list.resize(sum);
    for (std::size_t i = nodes.size(); i-- > 0;) {
      if (nodes[i].parent != k_none) list[--first[nodes[i].parent]] = static_cast<std::uint32_t>(i);
    }
  }
  std::span<const std::uint32_t> of(std::uint32_t node) const {
    return std::span(list).subspan(first[node], first[node + 1] - first[node]);
  }
};

void fit_spheres(std::span<const LeafGroup> groups, std::vector<Node>& nodes) {
  const Children children(nodes);
  std::vector<StoredSphere> below;
  for (auto n = static_cast<std::uint32_t>(nodes.size()); n-- > 0;) {
    if (nodes[n].group != k_none) {
      nodes[n].sphere = {groups[nodes[n].group].centre, groups[nodes[n].group].radius};
      continue;
    }
    below.clear();
    for (const std::uint32_t c : children.of(n)) below.push_back(nodes[c].sphere);
    nodes[n].sphere = stored_minimal_sphere(below);
  }
}

double surface(const StoredSphere& s) {
  return double{s.radius} * s.radius;
}

// Takes out inner nodes that cost a test and spare fewer: with m children, and met with probability p when
// the node above is, a node costs 1 + p m tests instead of m. Children move up. From the root down, so that
// what is above is final. Answers whether any was taken out.
bool take_out_needless(std::vector<Node>& nodes) {
  const Children children(nodes);
  std::vector<bool> out(nodes.size(), false);
  Indices above(nodes.size(), k_none);  // the nearest node above that stays
  for (std::uint32_t n = 1; n < nodes.size(); ++n) {
    const std::uint32_t parent = nodes[n].parent;
    above[n] = out[parent] ? above[parent] : parent;
    if (nodes[n].group != k_none) continue;
    const double all = surface(nodes[above[n]].sphere), own = surface(nodes[n].sphere);
    out[n] = static_cast<double>(children.of(n).size()) * (all - own) < all;
  }
  Indices number(nodes.size(), k_none);
  std::vector<Node> kept;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (out[n]) {
      number[n] = number[nodes[n].parent];  // stands for its children's parent
      continue;
    }
    number[n] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(nodes[n]);
    if (nodes[n].parent != k_none) kept.back().parent = number[nodes[n].parent];
  }
  const bool any = kept.size() < nodes.size();
  nodes = std::move(kept);
  return any;
}

}  // namespace

std::vector<GroupNode> group_hierarchy(std::span<const LeafGroup> groups, GroupBuilder builder) {
  if (groups.empty()) return {};
  std::vector<Node> nodes = build(groups, builder);
  fit_spheres(groups, nodes);
  if (builder == GroupBuilder::sweep) {
    // Spheres round more children are smaller, which makes a few more nodes needless; a third round finds
    // next to none.
    for (int round = 0; round < 2 && take_out_needless(nodes); ++round) fit_spheres(groups, nodes);
  }
  // build() wrote them depth first, and taking nodes out keeps that order.
  std::vector<GroupNode> out(nodes.size());
  for (std::uint32_t n = 0; n < nodes.size(); ++n) {
    out[n] = {nodes[n].sphere.centre, nodes[n].sphere.radius, n + 1, nodes[n].group};
  }
  for (auto n = static_cast<std::uint32_t>(nodes.size()); n-- > 1;) {
    std::uint32_t& skip = out[nodes[n].parent].skip;
    skip = std::max(skip, out[n].skip);
  }
  return out;
}

double expected_tests(std::span<const GroupNode> nodes) {
  std::vector<Sphere> bottom;
  for (const GroupNode& n : nodes) {
    if (n.group != k_none) bottom.push_back({to_double(n.centre), n.radius});
  }
  if (bottom.empty()) return 0;
  const double radius = minimal_sphere(bottom).radius;
  double tests = 1;
  for (std::uint32_t n = 0; n < nodes.size(); ++n) {
    if (nodes[n].group != k_none) continue;
    double children = 0;
    for (std::uint32_t c = n + 1; c < nodes[n].skip; c = nodes[c].skip) ++children;
    const double share = radius > 0 ? nodes[n].radius / radius : 1;
    tests += children * share * share;
  }
  return tests;
}

}  // namespace copse
