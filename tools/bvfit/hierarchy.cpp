#include "tools/bvfit/hierarchy.h"

#include "lib/analysis/bvh/cluster_tree.h"
#include "lib/analysis/bvh/hilbert_rtree.h"
#include "lib/analysis/bvh/kd_tree.h"

#include <algorithm>
#include <array>
#include <chrono>

#include <fmt/format.h>

namespace copse::bvfit {
namespace {

bool is_item(const PartSet& part) {
  const bool coarse = part.part == VolumePart::trunk || part.part == VolumePart::leaves ||
                      (part.part == VolumePart::whole && part.index == k_none);
  return !coarse && part.motion == VolumeMotion::rest;
}

// What is above an item in what the input came with: leaf groups, segments and cells apart; the file that a
// part of a scene came in.
std::vector<std::uint32_t> original_groups(std::span<const PartSet> parts,
                                           std::span<const std::size_t> items) {
  std::vector<std::uint32_t> out;
  for (const std::size_t i : items) {
    out.push_back(parts[i].part == VolumePart::whole ? parts[i].file
                                                     : static_cast<std::uint32_t>(parts[i].part));
  }
  return out;
}

constexpr std::array<const char*, 11> k_kinds{"kd2",    "kd3",    "kd4",      "kd8",      "kd16", "rtree2",
                                              "rtree4", "rtree8", "clusters", "original", "flat"};

// What finding all that a random ray (or plane) meets costs in tests: every child of a node that is met is
// tested; a node is met in proportion to its surface (mean width).
struct SearchCost {
  double rays = 0, planes = 0;
};
SearchCost search_cost(const Hierarchy& h, std::span<const SetFit> fits, const Choosing& choosing) {
  std::vector<const SetFit*> of(h.tree.nodes.size());
  std::size_t inner = 0;
  for (std::size_t i = 0; i < of.size(); ++i) {
    const BoxNode& n = h.tree.nodes[i];
    of[i] = n.item != k_none ? &fits[h.items[n.item]] : &h.inner[inner++];
  }
  const auto volume = [&](std::size_t i) -> const FittedVolume& { return of[i]->volumes[of[i]->chosen]; };
  const VolumeMeasures root = volume(0).measures;
  SearchCost cost;
  for (std::uint32_t i = 0; i < of.size(); ++i) {
    const BoxNode& n = h.tree.nodes[i];
    if (n.item != k_none) continue;
    double children = 0;
    for (std::uint32_t c = i + 1; c < n.skip; c = h.tree.nodes[c].skip) {
      Candidate candidate{volume(c).method.kind, {}, 0};
      if (const auto* k = std::get_if<Kdop<float>>(&volume(c).volume)) candidate.slabs = k->normals.size();
      children += choosing.costs.of(candidate);
    }
    const VolumeMeasures& m = volume(i).measures;
    cost.rays += children * (root.surface > 0 ? m.surface / root.surface : 1);
    cost.planes += children * (root.mean_width > 0 ? m.mean_width / root.mean_width : 1);
  }
  return cost;
}

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// T6.1 of the dissertation: the time to compute all volumes of its model 1.
const char* seed_time(const std::string& kind) {
  if (kind == "kd2") return "19 h 26 min";
  if (kind == "kd3") return "8 h 8 min";
  return kind == "kd4" ? "3 h 43 min" : "";
}

}  // namespace

Result<void> check_hierarchy(const std::string& kind, std::span<const PartSet> parts, const Input& input) {
  if (std::none_of(parts.begin(), parts.end(), is_item)) {
    return fail(Fault::usage, input.name, "a hierarchy needs parts to stand on",
                "add --per groups, segments, cells or parts");
  }
  if (!kind.empty() && std::find(k_kinds.begin(), k_kinds.end(), kind) == k_kinds.end()) {
    return fail(Fault::usage, "", fmt::format("--hierarchy knows no '{}'", kind),
                fmt::format("use {}", fmt::join(k_kinds, ", ")));
  }
  return {};
}

Result<Hierarchy> build_hierarchy(const std::string& kind, std::span<const PartSet> parts,
                                  const Input& input) {
  if (auto ok = check_hierarchy(kind, parts, input); !ok) return std::unexpected(ok.error());
  Hierarchy h;
  std::vector<DoubleBox> boxes;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!is_item(parts[i])) continue;
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
    h.tree = grouped_tree(original_groups(parts, h.items));
  } else {
    h.tree = flat_tree(static_cast<std::uint32_t>(boxes.size()));
  }
  return h;
}

Result<void> fit_hierarchy(Hierarchy& h, std::span<const PartSet> parts,
                           const std::vector<FitMethod>& methods, const Options& options,
                           const Choosing& choosing, Stage& stage) {
  std::vector<PartSet> sets;
  for (std::uint32_t i = 0; i < h.tree.nodes.size(); ++i) {
    const BoxNode& n = h.tree.nodes[i];
    if (n.item != k_none) continue;
    PartSet set;
    set.part = VolumePart::node, set.index = i;
    for (std::uint32_t j = n.first; j < n.first + n.count; ++j) {
      const PartSet& part = parts[h.items[h.tree.order[j]]];
      const std::vector<Double3>& points = part.envelope.empty() ? part.points : part.envelope;
      set.points.insert(set.points.end(), points.begin(), points.end());
      if (!part.envelope.empty()) set.motion = VolumeMotion::envelope, set.sway = part.sway;
    }
    set.name = set_name({.part = set.part, .index = i, .motion = set.motion});
    sets.push_back(std::move(set));
  }
  auto fits = fit_sets(sets, methods, options, choosing, stage);
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

Result<std::string> compare_hierarchies(std::span<const PartSet> parts, std::span<const SetFit> fits,
                                        const Input& input, const std::vector<FitMethod>& methods,
                                        const Options& options, const Choosing& choosing, Context& context) {
  Stage stage = context.stage("compare");
  const std::vector<std::string> columns{"hierarchy",          "nodes",         "depth",
                                         "build and fit, s",   "cost of a ray", "cost of a plane",
                                         "dissertation (T6.1)"};
  Table table{"Hierarchies", columns, {}};
  std::string out = fmt::format(
      "hierarchies over {} parts ({} triangles); costs in tests of a sphere\n\n    {:<10} {:>7} {:>6} {:>12} "
      "{:>12} {:>12}   {}\n",
      std::count_if(parts.begin(), parts.end(), is_item), input.mesh.triangles.size(), "kind", "nodes",
      "depth", "time, s", "a ray", "a plane", "dissertation, 394 670 faces");
  std::size_t nodes = 0;
  for (const std::string kind : k_kinds) {
    const double start = now();
    auto h = build_hierarchy(kind, parts, input);
    if (!h) return std::unexpected(h.error());
    if (auto ok = fit_hierarchy(*h, parts, methods, options, choosing, stage); !ok)
      return std::unexpected(ok.error());
    const double seconds = now() - start;
    nodes += h->inner.size();
    const SearchCost cost = search_cost(*h, fits, choosing);
    out +=
        fmt::format("    {:<10} {:>7} {:>6} {:>12.3g} {:>12.4g} {:>12.4g}   {}\n", kind, h->tree.nodes.size(),
                    depth(h->tree), seconds, cost.rays, cost.planes, seed_time(kind));
    table.rows.push_back({kind, std::to_string(h->tree.nodes.size()), std::to_string(depth(h->tree)),
                          fmt::format("{:.3g}", seconds), fmt::format("{:.4g}", cost.rays),
                          fmt::format("{:.4g}", cost.planes), seed_time(kind)});
  }
  stage.items(nodes, "nodes");
  context.report().tables.push_back(std::move(table));
  return out + "\n";
}

}  // namespace copse::bvfit
