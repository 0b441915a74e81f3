#include "tools/lodbake/spectra.h"

#include "lib/analysis/lod/coupling.h"
#include "lib/analysis/lod/edge_collapse.h"
#include "lib/analysis/lod/edge_spectrum.h"
#include "lib/analysis/lod/floating_leaves.h"
#include "lib/analysis/lod/foliage_pruning.h"
#include "lib/analysis/lod/leaf_collapse.h"
#include "lib/analysis/lod/piece_removal.h"
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

// Leaves wait for their twigs where twigs go one by one: by radii from the beginning, by edges where whole
// pieces go. Edge collapses move all of the trunk a little, and pruned leaves go all over the crown: nothing
// could go on. Nothing: no leaf waits.
std::optional<std::uint32_t> waits_from(const LodSpectra& spectra, std::uint32_t collapses) {
  if (spectra.leaves.method != LodMethod::collapse) return std::nullopt;
  return spectra.trunk.method == LodMethod::radii ? 0 : collapses;
}

bool has_limbs(const Tree& tree) {
  return tree.radius_count() > 0 && !tree.trunk.lines.empty();
}

void tell_lumps(const Tree& tree, const Options& options, const CollapsedLumps& lumps, Context& context) {
  // What is left of them is seen from both sides only where both are drawn.
  const bool single_sided = std::any_of(tree.materials.begin(), tree.materials.end(),
                                        [](const Material& m) { return !m.double_sided; });
  if (lumps.twins > 0 && single_sided)
    context.warn(
        fmt::format("{}: {} triangles of leaves lie on others, as in leaves made from both sides; levels "
                    "draw one of each: give leaves a double-sided material",
                    options.input.string(), lumps.twins));
  if (lumps.lumps == 0) return;
  context.report().tables.push_back(
      {.name = "leaves by edges",
       .columns = {"Lumps", "Triangles", "Share of the leaf area", "Edges until (triangles)"},
       .rows = {{fmt::format("{}", lumps.lumps), fmt::format("{}", lumps.triangles),
                 fmt::format("{:.3f}", lumps.share), fmt::format("{}", lumps.left)}}});
}

}  // namespace

Spectrum trunk_spectrum(const Tree& tree, const Options& options) {
  return options.trunk == TrunkMethod::edges || !has_limbs(tree)
             ? trunk_by_edges(tree, options)
             : trunk_by_radii(tree, {.order = options.removal});
}

LeafParts leaf_spectrum(const Tree& tree, const Looks& looks, const Options& options, std::uint64_t seed) {
  LeafParts out;
  if (options.foliage == FoliageMethod::collapse || tree.leaves.triangles.empty()) {
    out.spectrum = collapse_spectrum(tree, looks, {.quality = options.quality, .errors = false}, &out.lumps);
    return out;
  }
  // Small cells hold few leaves: these could not grow.
  const auto most = static_cast<std::uint32_t>(std::max<std::size_t>(1, tree.leaf_count() / k_leaves_a_cell));
  PruningOptions pruning = options.pruning;
  pruning.cells = options.cells_given ? options.cells : std::min(options.cells, most);
  pruning.views = options.views, pruning.seed = seed;
  pruning.near = options.near.value_or(0), pruning.far = options.far.value_or(0);
  out.cells = prune_foliage(tree, looks, pruning);
  out.spectrum = pruned_spectrum(tree, *out.cells);
  return out;
}

void divide(const Tree& tree, const Looks& looks, const Options& options, LodSpectra& spectra) {
  const bool both = !spectra.trunk.elements.empty() && !spectra.leaves.elements.empty();
  const std::uint32_t collapses = spectra.trunk.steps();
  if (spectra.trunk.method == LodMethod::edges)
    spectra.trunk = remove_pieces(spectra.trunk, options.min_triangles);
  LevelError error;
  std::optional<LevelPictures> pictures;
  if (both && options.division == Division::picture) {
    pictures.emplace(spectra, looks);
    error = [&](const TriedLevel& level) { return pictures->error(level); };
  }
  std::optional<FloatingLeaves> floating;
  CouplingOptions coupling{.min_triangles = options.min_triangles};
  if (const auto from = waits_from(spectra, collapses); both && from) {
    floating.emplace(tree, spectra, *from);
    coupling.floats_by = [&](std::uint32_t leaf, std::uint32_t steps) {
      return floating->floats_by(leaf, steps);
    };
  }
  couple(spectra, error, coupling);
}

Result<BakedSpectra> make_spectra(const Tree& tree, const Looks& looks, const Options& options,
                                  Context& context) {
  BakedSpectra baked;
  LodSpectra& spectra = baked.spectra;
  {
    Stage stage = context.stage("trunk");
    stage.items(tree.trunk.triangles.size(), "triangles");
    if (options.trunk == TrunkMethod::radii && !has_limbs(tree) && !tree.trunk.triangles.empty())
      context.warn(fmt::format("{}: without a hierarchy and its segments the trunk goes by edges",
                               options.input.string()));
    spectra.trunk = trunk_spectrum(tree, options);
  }
  {
    Stage stage = context.stage("leaves");
    stage.items(tree.leaves.triangles.size(), "triangles");
    LeafParts leaves = leaf_spectrum(tree, looks, options, context.options().seed);
    tell_lumps(tree, options, leaves.lumps, context);
    spectra.leaves = std::move(leaves.spectrum), baked.cells = std::move(leaves.cells);
  }
  if (options.sweep) baked.as_made = spectra;
  Stage stage = context.stage("divide");
  divide(tree, looks, options, spectra);
  stage.items(spectra.schedule.size(), "knots");
  return baked;
}

}  // namespace copse::lodbake
