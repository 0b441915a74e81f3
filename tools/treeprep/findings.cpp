#include "tools/treeprep/findings.h"

#include <algorithm>
#include <map>
#include <tuple>

#include <fmt/format.h>

namespace copse::treeprep {
namespace {

std::string count(std::uint64_t n) {
  return fmt::format("{}", n);
}

Table counts_table(const Findings& f) {
  Table table{"what was found", {"what", "count"}, {}};
  const auto add = [&](const char* what, std::uint64_t n) { table.rows.push_back({what, count(n)}); };
  std::uint64_t roots = 0, joints = 0, branches = 0;
  for (const RadiusNode& r : f.hierarchy.radii) {
    roots += r.parent == k_none, joints += r.joint;
    branches = std::max<std::uint64_t>(branches, r.branch + 1);
  }
  add("triangles in the mesh", f.mesh.triangles.size());
  add("trunk triangles", f.classes.trunk_triangles);
  add("degenerate trunk triangles, left out", f.classes.trunk_triangles - f.trunk.triangles.size());
  add("leaf triangles", f.classes.leaf_triangles);
  add("leaves", f.classes.leaf_count);
  add("leaf groups", f.tree.leaves.groups.size());
  if (f.merged_groups > 0) add("leaf groups made part of another", f.merged_groups);
  add("roots", roots);
  add("radii", f.hierarchy.radii.size());
  add("branches", branches);
  add("segments", f.tree.segment_count());
  add("branches joined to their parent without a surface", joints);
  return table;
}

// Which method found the radii where, and how much of the trunk each explains.
Table skeleton_table(const Findings& f) {
  static constexpr const char* k_names[] = {"rings of the mesh", "rings collapsed to a point",
                                            "surface skeleton"};
  std::uint64_t radii[3] = {}, triangles[3] = {}, unexplained = 0;
  for (const RadiusNode& r : f.hierarchy.radii) ++radii[static_cast<int>(r.source)];
  for (const std::uint32_t s : f.hierarchy.segment_of) {
    if (s == k_none) {
      ++unexplained;
    } else {
      ++triangles[static_cast<int>(f.hierarchy.radii[s].source)];
    }
  }
  Table table{"where the skeleton comes from",
              {"radii from", "radii", "trunk triangles given to their segments"},
              {}};
  for (int i = 0; i < 3; ++i) {
    if (radii[i] > 0) table.rows.push_back({k_names[i], count(radii[i]), count(triangles[i])});
  }
  if (unexplained > 0) table.rows.push_back({"nothing (caps, lumps)", "", count(unexplained)});
  return table;
}

Table components_table(const Mesh& mesh, std::span<const std::uint32_t> file_order,
                       const Classification& classes) {
  struct Sum {
    std::uint64_t components = 0, triangles = 0, first = 0;
  };
  std::vector<std::uint64_t> first(classes.components.size(), mesh.triangles.size());
  for (std::size_t t = 0; t < classes.component_of.size(); ++t) {
    std::uint64_t& lowest = first[classes.component_of[t]];
    lowest = std::min<std::uint64_t>(lowest, file_order.empty() ? t : file_order[t]);
  }
  std::map<std::tuple<PartClass, std::string_view, std::string_view>, Sum> sums;
  for (std::size_t i = 0; i < classes.components.size(); ++i) {
    const Component& c = classes.components[i];
    const std::uint32_t material = mesh.parts[c.part].material;
    const std::string_view name = material == k_none ? std::string_view() : mesh.materials[material].name;
    const auto [at, is_new] = sums.try_emplace({c.kind, c.reason, name});
    Sum& sum = at->second;
    sum.first = is_new ? first[i] : std::min(sum.first, first[i]);
    ++sum.components, sum.triangles += c.triangles;
  }
  Table table{"trunk and leaves, and why",
              {"class", "why", "material", "components", "triangles", "first triangle"},
              {}};
  for (const auto& [key, sum] : sums) {
    const auto& [kind, why, material] = key;
    table.rows.push_back({kind == PartClass::trunk ? "trunk" : "leaf", std::string(why),
                          std::string(material), count(sum.components), count(sum.triangles),
                          count(sum.first)});
  }
  return table;
}

// "surface of 24 triangles at mesh triangle 7: no rings" says the same of every surface.
std::string_view what_is_noted(std::string_view note) {
  const std::size_t colon = note.starts_with("surface of ") ? note.find(": ") : std::string_view::npos;
  return colon == std::string_view::npos ? note : note.substr(colon);
}

// Thousands of twigs may say the same: the first of them does.
Table notes_table(const std::vector<std::string>& notes) {
  std::map<std::string_view, std::uint64_t> more;
  std::vector<std::string_view> first;
  for (const std::string& note : notes) {
    if (more.try_emplace(what_is_noted(note), 0).second) {
      first.push_back(note);
    } else {
      ++more[what_is_noted(note)];
    }
  }
  Table table{"about the skeleton", {"note", "more like it"}, {}};
  for (const std::string_view note : first)
    table.rows.push_back({std::string(note), count(more[what_is_noted(note)])});
  return table;
}

ErrorRecord record(const char* name, const ErrorDistribution& d, const char* unit) {
  return {name, d.mean, unit, d.max, d.p95, d.rms, "input mesh"};
}

}  // namespace

void report_findings(const Findings& findings, Report& report) {
  report.tables.push_back(counts_table(findings));
  if (!findings.hierarchy.radii.empty()) report.tables.push_back(skeleton_table(findings));
  report.tables.push_back(components_table(findings.mesh, findings.file_order, findings.classes));
  if (findings.hierarchy.notes.empty()) return;
  report.tables.push_back(notes_table(findings.hierarchy.notes));
}

void report_errors(const CylinderError& error, Report& report) {
  report.errors.push_back(record("cylinder-surface of local radius", error.of_radius, "ratio"));
  report.errors.push_back(record("cylinder-surface of tree height", error.of_height, "ratio"));
  report.errors.push_back(
      {"trunk triangles unexplained", 1 - error.explained_triangles, "ratio", {}, {}, {}, "input mesh"});
  report.errors.push_back(
      {"trunk area unexplained", 1 - error.explained_area, "ratio", {}, {}, {}, "input mesh"});
}

void report_left_out(const std::vector<Omitted>& omitted, Report& report) {
  if (omitted.empty()) return;
  Table table{"left out", {"section", "bytes saved"}, {}};
  for (const Omitted& o : omitted)
    table.rows.push_back({o.name, o.bytes > 0 ? count(o.bytes) : std::string("never made")});
  report.tables.push_back(std::move(table));
}

}  // namespace copse::treeprep
