#include "lib/formats/tree/check_parts.h"
#include "lib/formats/volumes/sphere_contains.h"

#include <cmath>

#include <fmt/format.h>

namespace copse {
namespace {

bool check_numbers(const Check& check) {
  const auto& nodes = check.tree.leaves.group_hierarchy;
  bool sound = true;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (is_finite(nodes[i].centre) && std::isfinite(nodes[i].radius) && nodes[i].radius >= 0) continue;
    check.add("LGHI", i, "the sphere is not finite or its radius negative");
    sound = false;
  }
  return sound;
}

// Depth first: every node ends where its last child ends. Calls link(parent, child) for each pair.
template <class Link>
bool walk(const Check& check, Link&& link) {
  const auto& nodes = check.tree.leaves.group_hierarchy;
  std::vector<std::size_t> above;  // the nodes that the next one is below
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    while (!above.empty() && nodes[above.back()].skip == i) above.pop_back();
    if (i > 0 && above.empty()) {
      check.add("LGHI", i, "a second root");
      return false;
    }
    const std::size_t end = above.empty() ? nodes.size() : nodes[above.back()].skip;
    const bool bottom = nodes[i].group != k_none;
    if (nodes[i].skip <= i || nodes[i].skip > end || bottom != (nodes[i].skip == i + 1)) {
      check.add("LGHI", i, "skips to where it cannot",
                [&] { return fmt::format("{}, below a node that ends at {}", nodes[i].skip, end); });
      return false;
    }
    if (!above.empty()) link(above.back(), i);
    if (!bottom) above.push_back(i);
  }
  return true;
}

bool check_bottom(const Check& check) {
  const auto& nodes = check.tree.leaves.group_hierarchy;
  std::vector<bool> seen(check.counts().groups);
  bool sound = true;
  const auto bad = [&](std::size_t i, const char* kind, std::uint32_t group) {
    check.add("LGHI", i, kind, [&] { return fmt::format("{} of {}", group, seen.size()); });
    sound = false;
  };
  std::size_t found = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::uint32_t group = nodes[i].group;
    if (group == k_none) continue;
    if (group >= seen.size()) {
      bad(i, "leaf group out of range", group);
      continue;
    }
    if (seen[group]) bad(i, "a leaf group that is there twice", group);
    seen[group] = true;
    ++found;
  }
  if (sound && found != seen.size()) {
    check.add("LGHI", Finding::k_no_element, "not every leaf group is there",
              [&] { return fmt::format("{} of {}", found, seen.size()); });
  }
  return sound;
}

}  // namespace

void check_group_hierarchy(const Check& check) {
  const auto& nodes = check.tree.leaves.group_hierarchy;
  if (nodes.empty()) return;
  const bool numbers = check_numbers(check);
  const bool bottom = check_bottom(check);
  walk(check, [&](std::size_t parent, std::size_t child) {
    if (!numbers ||
        sphere_contains(nodes[parent].centre, nodes[parent].radius, nodes[child].centre, nodes[child].radius))
      return;
    check.add("LGHI", parent, "a node's sphere sticks out of the one above",
              [&] { return fmt::format("node {}", child); });
  });
  const auto& groups = check.tree.leaves.groups;
  if (!numbers || !bottom || groups.empty()) return;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].group == k_none) continue;
    const LeafGroup& group = groups[nodes[i].group];
    if (!is_finite(group.centre) || !(group.radius >= 0)) continue;  // said already
    if (sphere_contains(nodes[i].centre, nodes[i].radius, group.centre, group.radius)) continue;
    check.add("LGHI", i, "a leaf group's sphere sticks out of its node's",
              [&] { return fmt::format("group {}", nodes[i].group); });
  }
}

}  // namespace copse
