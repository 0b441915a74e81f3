#include "tools/bvfit/hierarchy.h"

#include "lib/analysis/bvh/cluster_tree.h"
#include "lib/analysis/bvh/hilbert_rtree.h"
#include "lib/analysis/bvh/kd_tree.h"
#include "tools/bvfit/grouping.h"

#include <algorithm>

#include <fmt/format.h>

namespace copse::bvfit {
namespace {

// The points of all nodes together: some hours of fitting.
constexpr std::uint64_t k_most_node_points = std::uint64_t{1} << 34;

BoxTree original_tree(std::span<const PartSet> parts, std::span<const std::size_t> items,
                      const Input& input) {
  const Grouping grouping = input.file ? grouping_of_tree(input.tree) : grouping_of_scene(input.groups);
  std::vector<std::uint32_t> group_of;
  for (const std::size_t i : items) group_of.push_back(grouping.group_of(parts[i]));
  return nested_tree(grouping.parents, group_of);
}

// Of an inner node: everything below it.
PartSet set_of_node(const Hierarchy& h, std::uint32_t node, std::span<const PartSet> parts) {
  const BoxNode& n = h.tree.nodes[node];
  PartSet set;
  set.part = VolumePart::node, set.index = node;
  for (std::uint32_t j = n.first; j < n.first + n.count; ++j) {
    const PartSet& part = parts[h.items[h.tree.order[j]]];
    const std::vector<Double3>& points = part.envelope.empty() ? part.points : part.envelope;
    set.points.insert(set.points.end(), points.begin(), points.end());
    if (!part.envelope.empty()) set.motion = VolumeMotion::envelope, set.sway = part.sway;
  }
  set.name = set_name({.part = set.part, .index = node, .motion = set.motion});
  return set;
}

std::uint64_t points_below(const Hierarchy& h, const BoxNode& n, std::span<const PartSet> parts) {
  std::uint64_t points = 0;
  for (std::uint32_t j = n.first; j < n.first + n.count; ++j) {
    const PartSet& part = parts[h.items[h.tree.order[j]]];
    points += part.envelope.empty() ? part.points.size() : part.envelope.size();
  }
  return points;
}

}  // namespace

bool is_fine_part(VolumePart part, std::uint32_t index, VolumeMotion motion) {
  const bool coarse = part == VolumePart::trunk || part == VolumePart::leaves || part == VolumePart::node ||
                      (part == VolumePart::whole && index == k_none);
  return !coarse && motion == VolumeMotion::rest;
}

bool is_hierarchy_item(const PartSet& part) {
  return is_fine_part(part.part, part.index, part.motion);
}

Result<void> check_hierarchy(const std::string& kind, std::span<const PartSet> parts, const Input& input) {
  if (std::none_of(parts.begin(), parts.end(), is_hierarchy_item)) {
    return fail(Fault::usage, input.name, "a hierarchy needs parts to stand on",
                "add --per groups, segments, cells or parts");
  }
  if (!kind.empty() && std::find(k_hierarchies.begin(), k_hierarchies.end(), kind) == k_hierarchies.end()) {
    return fail(Fault::usage, "", fmt::format("--hierarchy knows no '{}'", kind),
                fmt::format("use {}", fmt::join(k_hierarchies, ", ")));
  }
  return {};
}

Result<Hierarchy> build_hierarchy(const std::string& kind, std::span<const PartSet> parts,
                                  const Input& input) {
  if (auto ok = check_hierarchy(kind, parts, input); !ok) return std::unexpected(ok.error());
  Hierarchy h;
  std::vector<DoubleBox> boxes;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!is_hierarchy_item(parts[i])) continue;
    h.items.push_back(i);
    boxes.emplace_back();
    for (const Double3& p : parts[i].points) boxes.back().grow(p);
  }
  const auto k = [&](std::string_view prefix) {
    return static_cast<std::uint32_t>(std::stoul(kind.substr(prefix.size())));
  };
  if (kind.starts_with("kd")) {
    h.tree = kd_tree(boxes, k("kd"));
  } else if (kind.starts_with("rtree")) {
    h.tree = hilbert_rtree(boxes, k("rtree"));
  } else if (kind == "clusters") {
    h.tree = cluster_tree(boxes);
  } else if (kind == "original") {
    h.tree = original_tree(parts, h.items, input);
  } else {
    h.tree = flat_tree(static_cast<std::uint32_t>(boxes.size()));
  }
  return h;
}

Result<void> fit_hierarchy(Hierarchy& h, std::span<const PartSet> parts,
                           const std::vector<FitMethod>& methods, const Options& options,
                           const Choosing& choosing, Stage& stage) {
  std::vector<std::uint32_t> inner;
  std::uint64_t points = 0;
  for (std::uint32_t i = 0; i < h.tree.nodes.size(); ++i) {
    if (h.tree.nodes[i].item != k_none) continue;
    inner.push_back(i);
    points += points_below(h, h.tree.nodes[i], parts);
  }
  if (points > k_most_node_points) {
    return refuse("",
                  fmt::format("the nodes of its hierarchy hold {} points together, {} are allowed", points,
                              k_most_node_points),
                  "use another --hierarchy");
  }
  // A node's points are gathered when its turn comes: together they are the scene times the depth.
  auto fits = fit_sets(
      inner.size(), [&](std::size_t i) { return set_of_node(h, inner[i], parts); }, methods, options,
      choosing, stage);
  if (!fits) return std::unexpected(fits.error());
  h.inner = std::move(*fits);
  stage.items(h.inner.size(), "nodes");
  return {};
}

std::vector<VolumeNode> stored_nodes(const Hierarchy& h, std::span<const SetFit> fits) {
  std::vector<VolumeNode> nodes;
  std::size_t inner = 0;
  for (const BoxNode& n : h.tree.nodes) {
    if (n.item != k_none) {
      const std::size_t part = h.items[n.item];
      nodes.push_back({n.skip, fits[part].index, static_cast<std::uint32_t>(part)});
    } else {
      nodes.push_back({n.skip, k_none, static_cast<std::uint32_t>(fits.size() + inner++)});
    }
  }
  return nodes;
}

}  // namespace copse::bvfit
