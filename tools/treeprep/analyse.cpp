#include "tools/treeprep/analyse.h"

#include "lib/analysis/measure/cylinder_error.h"
#include "lib/analysis/tree/lone_segment.h"
#include "lib/analysis/trunk/recover.h"
#include "lib/analysis/trunk/stray_roots.h"
#include "tools/treeprep/strict_stage.h"
#include "tools/treeprep/texture_stage.h"

#include <algorithm>

#include <fmt/format.h>

namespace copse::treeprep {
namespace {

Result<Classification> classify_stage(const Input& input, const Options& options, Context& context) {
  Stage stage = context.stage("classify");
  stage.items(input.mesh.triangles.size(), "triangles");
  auto classes = classify(input.mesh, {options.trunk_patterns, options.leaf_patterns});
  if (!classes && classes.error().file.empty()) classes.error().file = input.name;
  return classes;
}

// A tolerance of the user's that makes nothing of much of the trunk.
void warn_of_lost(const Input& input, std::ptrdiff_t before, std::size_t after, const Options& options,
                  Context& context) {
  const std::size_t lost = static_cast<std::size_t>(before) - after;
  if (options.weld < 0 || lost * 100 <= static_cast<std::size_t>(before)) return;
  context.warn(fmt::format("{}: --weld {} leaves no area to {} of {} trunk triangles; use a smaller one",
                           input.name, options.weld, lost, before));
}

TrunkMesh weld_stage(const Input& input, const Classification& classes, const Options& options,
                     Context& context) {
  Stage stage = context.stage("weld");
  std::vector<std::uint8_t> is_trunk(input.mesh.triangles.size());
  for (std::size_t t = 0; t < is_trunk.size(); ++t) is_trunk[t] = classes.leaf_of[t] == k_none;
  TrunkMesh trunk = make_trunk_mesh(input.mesh, is_trunk, weld_tolerance(input, options), input.file_order);
  stage.items(trunk.triangles.size(), "trunk triangles");
  warn_of_lost(input, std::ranges::count(is_trunk, 1), trunk.triangles.size(), options, context);
  return trunk;
}

// A recovery that failed is not silent: a look at some of the triangles tells.
void warn_of_unexplained(const Input& input, const TrunkMesh& trunk, const Hierarchy& hierarchy,
                         Context& context) {
  constexpr double k_usual = 0.05;  // caps and lumps
  constexpr std::size_t k_looked_at = 20000;
  if (hierarchy.radii.empty()) return;
  const std::size_t every = trunk.triangles.size() / k_looked_at | 1;  // odd: quads are cut in two
  const double unexplained = 1 - cylinder_error(trunk, hierarchy, 0, every).explained_triangles;
  if (unexplained <= k_usual) return;
  context.warn(
      fmt::format("{}: {:.0f} % of the trunk's triangles fit none of the branches that were found in it: "
                  "feet and cuts of "
                  "branches, lumps, or what is no trunk, which --leaf says; --html shows them",
                  input.name, 100 * unexplained));
}

// A tree that fell apart explains its triangles as well as one that did not.
void warn_of_stray_roots(const Input& input, const Hierarchy& hierarchy, Context& context) {
  const std::vector<std::uint32_t> stray = stray_roots(hierarchy);
  if (stray.empty()) return;
  const Double3& at = hierarchy.radii[stray.front()].centre;
  context.warn(fmt::format(
      "{}: {} of the limbs begin{} in the air, held by nothing that was found, and {} of {} own; the "
      "first at {:.6g},{:.6g},{:.6g}",
      input.name, stray.size(), stray.size() == 1 ? "s" : "", stray.size() == 1 ? "is a tree" : "are trees",
      stray.size() == 1 ? "its" : "their", at.x, at.y, at.z));
}

Hierarchy skeleton_stage(const Input& input, const TrunkMesh& trunk, const Options& options,
                         Context& context) {
  Stage stage = context.stage("skeleton");
  stage.items(trunk.triangles.size(), "trunk triangles");
  Hierarchy hierarchy = recover_hierarchy(trunk, {.skeleton = options.skeleton, .roots = options.roots});
  add_lone_segment(trunk, hierarchy);
  warn_of_unexplained(input, trunk, hierarchy, context);
  warn_of_stray_roots(input, hierarchy, context);
  return hierarchy;
}

}  // namespace

Result<Analysis> analyse(Input& input, const Options& options, TreeKind kind, const LeftOut& left_out,
                         Context& context) {
  Analysis a;
  auto classes = classify_stage(input, options, context);
  if (!classes) return std::unexpected(classes.error());
  a.classes = std::move(*classes);
  if (options.strict) {
    auto strict = strict_stage(input, a.classes, options, context);
    if (!strict) return std::unexpected(strict.error());
    a.trunk = std::move(strict->mesh), a.hierarchy = std::move(strict->hierarchy);
    add_lone_segment(a.trunk, a.hierarchy);
  }
  if (!left_out.textures) {
    if (const auto ok = texture_stage(input, options, context); !ok) return std::unexpected(ok.error());
  }
  if (!options.strict) {
    a.trunk = weld_stage(input, a.classes, options, context);
    a.hierarchy = skeleton_stage(input, a.trunk, options, context);
    a.trunk.piece = {}, a.trunk.file_order = {};  // only rings are read by them
  }
  const Double3 origin = choose_origin(bounds(input.mesh));
  a.leaves = leaf_stage(input, a.classes, a.hierarchy, origin, options, left_out, context);

  Stage stage = context.stage("assemble");
  stage.items(input.mesh.triangles.size(), "triangles");
  a.assembled = assemble({input.mesh, a.trunk, a.hierarchy, a.leaves.geometry, a.leaves.groups, origin,
                          input.undefined_materials},
                         {.kind = kind, .leaf_order = options.leaf_order});
  if (a.assembled.mixed_materials > 0) {
    context.warn(fmt::format("{}: {} leaves use several materials; each is stored with its first", input.name,
                             a.assembled.mixed_materials));
  }
  return a;
}

}  // namespace copse::treeprep
