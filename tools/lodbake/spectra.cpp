#include "tools/lodbake/spectra.h"

#include "lib/analysis/lod/coupling.h"
#include "lib/analysis/lod/edge_collapse.h"
#include "lib/analysis/lod/edge_spectrum.h"
#include "lib/analysis/lod/floating_leaves.h"
#include "lib/analysis/lod/foliage_pruning.h"
#include "lib/analysis/lod/leaf_collapse.h"
#include "lib/analysis/lod/trunk_radii.h"
#include "tools/lodbake/level_pictures.h"

#include <algorithm>
#include <optional>
#include <vector>

#include <fmt/format.h>

namespace copse::lodbake {
namespace {

constexpr std::size_t k_leaves_a_cell = 32;  // at least, where --cells is not given

// By edges, every triangle hangs on the child radius of its segment.
Spectrum trunk_by_edges(const Tree& tree, const Options& options) {
  const PartTriangles trunk = trunk_triangles(tree);
  std::vector<std::uint32_t> radius(trunk.triangles.size(), k_none);
  const bool hierarchy = tree.radius_count() > 0 && !tree.trunk.lines.empty();
  for (std::size_t s = 0; hierarchy && s < tree.segment_count(); ++s) {
    for (std::size_t t = tree.first_triangle_of_segment(s); t < tree.first_triangle_of_segment(s + 1); ++t)
      radius[t] = tree.trunk.lines[s][1];
  }
  return edge_spectrum(trunk, collapse_edges(trunk, {.min_triangles = options.min_triangles}), radius);
}

Spectrum trunk_spectrum(const Tree& tree, const Options& options, Context& context) {
  Stage stage = context.stage("trunk");
  stage.items(tree.trunk.triangles.size(), "triangles");
  const bool hierarchy = tree.radius_count() > 0 && !tree.trunk.lines.empty();
  if (options.trunk == TrunkMethod::radii && !hierarchy && !tree.trunk.triangles.empty())
    context.warn(fmt::format("{}: without a hierarchy and its segments the trunk goes by edges",
                             options.input.string()));
  return options.trunk == TrunkMethod::edges || !hierarchy ? trunk_by_edges(tree, options)
                                                           : trunk_by_radii(tree, {.order = options.removal});
}

Spectrum collapsed(const Tree& tree, const Looks& looks, const Options& options, Context& context) {
  CollapsedLumps lumps;
  Spectrum s = collapse_spectrum(tree, looks, {.quality = options.quality, .errors = false}, &lumps);
  // What is left of them is seen from both sides only where both are drawn.
  const bool single_sided = std::any_of(tree.materials.begin(), tree.materials.end(),
                                        [](const Material& m) { return !m.double_sided; });
  if (lumps.twins > 0 && single_sided)
    context.warn(
        fmt::format("{}: {} triangles of leaves lie on others, as in leaves made from both sides; levels "
                    "draw one of each: give leaves a double-sided material",
                    options.input.string(), lumps.twins));
  if (lumps.lumps > 0)
    context.report().tables.push_back(
        {.name = "leaves by edges",
         .columns = {"Lumps", "Triangles", "Share of the leaf area", "Edges until (triangles)"},
         .rows = {{fmt::format("{}", lumps.lumps), fmt::format("{}", lumps.triangles),
                   fmt::format("{:.3f}", lumps.share), fmt::format("{}", lumps.left)}}});
  return s;
}

Spectrum leaf_spectrum(const Tree& tree, const Looks& looks, const Options& options, Context& context,
                       std::optional<FoliageCells>& cells) {
  Stage stage = context.stage("leaves");
  stage.items(tree.leaves.triangles.size(), "triangles");
  if (options.foliage == FoliageMethod::collapse || tree.leaves.triangles.empty())
    return collapsed(tree, looks, options, context);
  // Small cells hold few leaves: these could not grow.
  const auto most = static_cast<std::uint32_t>(std::max<std::size_t>(1, tree.leaf_count() / k_leaves_a_cell));
  cells = prune_foliage(tree, looks,
                        {.cells = options.cells_given ? options.cells : std::min(options.cells, most),
                         .views = options.views,
                         .seed = context.options().seed,
                         .near = options.near.value_or(0),
                         .far = options.far.value_or(0)});
  return pruned_spectrum(tree, *cells);
}

}  // namespace

Result<BakedSpectra> make_spectra(const Tree& tree, const Looks& looks, const Options& options,
                                  Context& context) {
  BakedSpectra baked;
  LodSpectra& spectra = baked.spectra;
  spectra.trunk = trunk_spectrum(tree, options, context);
  spectra.leaves = leaf_spectrum(tree, looks, options, context, baked.cells);
  Stage stage = context.stage("divide");
  const bool both = !spectra.trunk.elements.empty() && !spectra.leaves.elements.empty();
  LevelError error;
  std::optional<LevelPictures> pictures;
  if (both && options.division == Division::picture) {
    pictures.emplace(spectra, looks);
    error = [&](const TriedLevel& level) { return pictures->error(level); };
  }
  // Leaves wait for their twigs where twigs go one by one. Edge collapses move all of the trunk a little, and
  // pruned leaves go all over the crown: nothing could go on.
  std::optional<FloatingLeaves> floating;
  CouplingOptions coupling{.min_triangles = options.min_triangles};
  if (both && spectra.trunk.method == LodMethod::radii && spectra.leaves.method == LodMethod::collapse) {
    floating.emplace(tree, spectra);
    coupling.floats_by = [&](std::uint32_t leaf, std::uint32_t steps) {
      return floating->floats_by(leaf, steps);
    };
  }
  couple(spectra, error, coupling);
  stage.items(spectra.schedule.size(), "knots");
  return baked;
}

}  // namespace copse::lodbake
