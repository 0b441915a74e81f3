#include "tools/treeplay/tree_levels.h"

#include "lib/formats/levels/spectrum_file.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>

namespace copse::treeplay {

TreeLevels::TreeLevels(LodSpectra spectra, const Tree& tree)
    : spectra_(std::move(spectra)), trunk_(spectra_.trunk), leaves_(spectra_.leaves) {
  Tree rest = tree;
  if (!spectra_.trunk.elements.empty()) rest.trunk = {}, rest.hierarchy = {};
  if (!spectra_.leaves.elements.empty()) rest.leaves = {};
  base_ = make_geometry(rest);
  own_triangles_ = base_.indices.size() / 3;
  base_.origin = tree.header.origin;
  first_trunk_vertex_ = static_cast<std::uint32_t>(base_.vertices.size());
  add_vertices(spectra_.trunk);
  first_leaf_vertex_ = static_cast<std::uint32_t>(base_.vertices.size());
  add_vertices(spectra_.leaves);
}

void TreeLevels::add_vertices(const Spectrum& spectrum) {
  for (const SpectrumVertex& v : spectrum.vertices)
    base_.vertices.push_back({v.position, v.normal, v.texcoord});
}

Result<std::shared_ptr<const TreeLevels>> TreeLevels::load(const TreeFile& file, const Tree& tree) {
  if (!has_spectra(file.container())) return std::shared_ptr<const TreeLevels>();
  auto spectra = load_spectra(file.container(), tree.radius_count(), tree.materials.size());
  if (!spectra) return std::unexpected(spectra.error());
  auto atlas = read_impostor(file);
  if (!atlas) return std::unexpected(atlas.error());
  const std::shared_ptr<TreeLevels> levels(new TreeLevels(std::move(*spectra), tree));
  if (!atlas->empty()) levels->impostor_ = {std::move(*atlas), file.container().name()};
  return levels;
}

TreeGeometry TreeLevels::geometry() const {
  TreeGeometry out = base_;
  take({}, out);
  for (const std::uint32_t i : out.indices) out.bounds.grow(out.vertices[i].position);
  return out;
}

void TreeLevels::append(const LevelExtractor& extractor, DrawPart part, std::uint32_t steps,
                        TreeGeometry& out) const {
  const std::uint32_t shift = part == DrawPart::trunk ? first_trunk_vertex_ : first_leaf_vertex_;
  for (const std::uint32_t material : extractor.materials()) {
    const std::size_t first = out.indices.size();
    out.indices.resize(first + extractor.capacity());
    const std::size_t count = extractor.extract(steps, material, std::span(out.indices).subspan(first));
    out.indices.resize(first + count);
    for (std::size_t i = first; i < out.indices.size(); ++i) out.indices[i] += shift;
    out.ranges.push_back(
        {part, material, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count)});
  }
}

void TreeLevels::take(const LodLevel& level, TreeGeometry& geometry) const {
  geometry.indices.assign(base_.indices.begin(), base_.indices.end());
  geometry.ranges = base_.ranges;
  append(trunk_, DrawPart::trunk, level.trunk_steps, geometry);
  append(leaves_, DrawPart::leaves, level.leaf_steps, geometry);
}

Result<LevelChoice> LevelChoice::make(std::shared_ptr<const TreeLevels> levels, const DetailWish& wish,
                                      const std::filesystem::path& file) {
  LevelChoice choice;
  choice.levels_ = std::move(levels);
  const auto no_level = [&](const std::string& what, const std::string& remedy) {
    return refuse(file.string(), what, remedy);
  };
  if (!choice.levels_ && wish.needs_levels()) {
    const bool is_tree = file.extension() == ".tree" || file.extension() == ".stree";
    return no_level("holds no levels of detail",
                    is_tree ? "bake them with lodbake, and play what it writes"
                            : "make a tree of it with treeprep, and its levels with lodbake");
  }
  if (!choice.levels_) return choice;
  const LodSpectra& spectra = choice.levels_->spectra();
  choice.shown_ = choice.numbered(0);
  if (wish.level) {
    if (*wish.level > choice.levels_->last())
      return no_level(fmt::format("holds the discrete levels 0 to {}, there is none numbered {}",
                                  choice.levels_->last(), *wish.level),
                      "name one of them, or bake more with lodbake --discrete");
    choice.shown_ = choice.numbered(static_cast<std::uint32_t>(*wish.level));
  }
  const double full = full_detail(spectra).triangles;
  if (wish.ratio && *wish.ratio < 1)
    choice.shown_ = {k_none,
                     level_of_triangles(spectra, static_cast<std::uint64_t>(std::floor(*wish.ratio * full))),
                     false};
  if (wish.max_error) choice.shown_ = {k_none, level_of_error(spectra, *wish.max_error), false};
  if (wish.lod == Lod::spectrum && spectra.schedule.empty())
    return no_level("holds discrete levels alone", "bake with lodbake --continuous, or play with --lod auto");
  if (wish.lod == Lod::spectrum) choice.way_ = Way::continuous;
  if (wish.lod == Lod::automatic) choice.choose_by_distance();
  return choice;
}

ShownLevel LevelChoice::numbered(std::uint32_t number) const {
  const LodSpectra& spectra = levels_->spectra();
  const auto levels = static_cast<std::uint32_t>(spectra.discrete.size());
  const std::uint32_t drawn = std::min(number, levels);
  return {number, drawn == 0 ? full_detail(spectra) : spectra.discrete[drawn - 1], number > levels};
}

const ShownLevel& LevelChoice::at(double distance) {
  if (!levels_ || way_ == Way::fixed) return shown_;
  const LodSpectra& spectra = levels_->spectra();
  const auto& impostor = levels_->impostor();
  if (impostor && choose_impostor(spectra, impostor->atlas.distance, distance, shown_.impostor))
    shown_ = numbered(levels_->last());
  else if (way_ == Way::continuous)
    shown_ = {k_none, level_of_distance(spectra, held_ = held_distance(spectra, distance, held_)), false};
  else
    shown_ =
        numbered(choose_discrete(spectra, distance, shown_.impostor ? shown_.number - 1 : shown_.number));
  return shown_;
}

void LevelChoice::step(int coarser) {
  if (!levels_) return;
  const LodSpectra& spectra = levels_->spectra();
  const auto last = static_cast<int>(levels_->last());
  int number = static_cast<int>(shown_.number);
  if (shown_.number == k_none) {
    // From between two levels to the next one in that direction.
    const auto at =
        std::partition_point(spectra.discrete.begin(), spectra.discrete.end(),
                             [&](const LodLevel& l) { return l.triangles >= shown_.level.triangles; });
    number = static_cast<int>(at - spectra.discrete.begin()) + (coarser > 0 ? 0 : 1);
  }
  way_ = Way::fixed;
  shown_ = numbered(static_cast<std::uint32_t>(std::clamp(number + coarser, 0, last)));
}

void LevelChoice::choose_by_distance() {
  if (!levels_) return;
  way_ = levels_->spectra().discrete.empty() ? Way::continuous : Way::discrete;
}

}  // namespace copse::treeplay
