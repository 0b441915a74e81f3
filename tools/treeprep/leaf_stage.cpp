#include "tools/treeprep/leaf_stage.h"

#include "lib/analysis/leaves/group_hierarchy.h"
#include "lib/analysis/leaves/leaf_groups.h"

#include <utility>

namespace copse::treeprep {
namespace {

// The radii that leaves hang on: those without children.
std::vector<std::uint32_t> terminal_radii(const Hierarchy& hierarchy) {
  std::vector<bool> has_child(hierarchy.radii.size(), false);
  for (const RadiusNode& r : hierarchy.radii) {
    if (r.parent != k_none) has_child[r.parent] = true;
  }
  std::vector<std::uint32_t> terminal;
  for (std::uint32_t r = 0; r < has_child.size(); ++r) {
    if (!has_child[r]) terminal.push_back(r);
  }
  return terminal;
}

TreeGroups group_leaves(const Mesh& mesh, const LeafGeometry& leaves, const Hierarchy& hierarchy,
                        const GroupOptions& options, std::uint32_t& merged) {
  const std::vector<std::uint32_t> terminal = terminal_radii(hierarchy);
  std::vector<Double3> centres;
  for (const std::uint32_t r : terminal) centres.push_back(hierarchy.radii[r].centre);
  LeafGroups found = leaf_groups(mesh, leaves, centres, options);
  merged = found.merged;
  TreeGroups groups;
  groups.groups = std::move(found.groups);
  groups.order = std::move(found.order);
  groups.group_of_radius.assign(hierarchy.radii.size(), k_none);
  for (std::size_t i = 0; i < terminal.size(); ++i)
    groups.group_of_radius[terminal[i]] = found.of_terminal[i];
  return groups;
}

}  // namespace

LeafStage leaf_stage(const Input& input, const Classification& classes, const Hierarchy& hierarchy,
                     const Double3& origin, const Options& options, const LeftOut& left_out,
                     Context& context) {
  LeafStage out;
  Stage stage = context.stage("leaf groups");
  stage.items(classes.leaf_count, "leaves");
  out.geometry = leaf_geometry(input.mesh, classes);
  if (left_out.groups) return out;
  out.groups = group_leaves(input.mesh, out.geometry, hierarchy,
                            {.order = options.leaf_order,
                             .seed = context.options().seed,
                             .max_groups = options.max_leaf_groups,
                             .origin = origin},
                            out.merged);
  if (!left_out.group_hierarchy) out.groups.hierarchy = group_hierarchy(out.groups.groups);
  return out;
}

}  // namespace copse::treeprep
