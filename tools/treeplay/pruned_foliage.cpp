#include "tools/treeplay/pruned_foliage.h"

#include "tools/treeplay/range_owners.h"

#include <cmath>
#include <utility>

namespace copse::treeplay {

PrunedFoliage::PrunedFoliage(const Tree& tree, FoliageCells cells, TreeGeometry& geometry)
    : cells_(std::make_unique<const FoliageCells>(std::move(cells))),
      levels_(*cells_, leaf_sizes(tree, *cells_)),
      centres_(tree.leaves.centres.to_vector()) {
  centres_.resize(tree.leaf_count());
  const std::vector<std::uint32_t> order = leaves_in_order(tree);
  leaf_of_ = range_owners(tree, geometry.ranges);
  first_vertex_ = static_cast<std::uint32_t>(geometry.vertices.size());
  for (std::size_t r = 0; r < geometry.ranges.size(); ++r) {
    const DrawRange& range = geometry.ranges[r];
    if (range.part != DrawPart::leaves) {
      leaf_of_[r].clear();
      continue;
    }
    for (std::uint32_t& leaf : leaf_of_[r]) leaf = order[leaf];
    for (std::uint32_t i = range.first_index; i < range.first_index + range.index_count; ++i) {
      const DrawVertex vertex = geometry.vertices[geometry.indices[i]];
      geometry.indices[i] = static_cast<std::uint32_t>(geometry.vertices.size());
      geometry.vertices.push_back(vertex);
    }
  }
}

void PrunedFoliage::select(const TreeGeometry& geometry, const Double3& eye, Frame& out) const {
  std::vector<CellLevel> levels(levels_.cell_count());
  levels_.choose(eye, {}, levels);
  out.leaf_count = 0;
  for (const CellLevel& level : levels) out.leaf_count += level.count;
  std::vector<float> scale(centres_.size(), 0);  // of lengths; 0: not drawn
  for (std::size_t c = 0; c < levels.size(); ++c) {
    const FoliageCell& cell = cells_->cells[c];
    for (std::uint32_t i = 0; i < levels[c].count; ++i) {
      const float area = levels_.enlargement(levels[c], cell.first + i),
                  left = i + 1 == levels[c].count ? levels[c].last : 1.0f;
      scale[cells_->order[cell.first + i]] = std::sqrt(area * left);
    }
  }
  out.leaves.assign(geometry.vertices.begin() + first_vertex_, geometry.vertices.end());
  out.indices.clear();
  out.ranges = geometry.ranges;
  for (std::size_t r = 0; r < out.ranges.size(); ++r) {
    DrawRange& range = out.ranges[r];
    const auto begin = geometry.indices.begin() + range.first_index;
    range.first_index = static_cast<std::uint32_t>(out.indices.size());
    if (range.part != DrawPart::leaves)
      out.indices.insert(out.indices.end(), begin, begin + range.index_count);
    for (std::size_t t = 0; t < leaf_of_[r].size(); ++t) {
      const std::uint32_t leaf = leaf_of_[r][t];
      if (scale[leaf] == 0) continue;
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t v = begin[static_cast<std::ptrdiff_t>(3 * t + c)];
        Float3& p = out.leaves[v - first_vertex_].position;
        p = centres_[leaf] + (p - centres_[leaf]) * scale[leaf];
        out.indices.push_back(v);
      }
    }
    range.index_count = static_cast<std::uint32_t>(out.indices.size()) - range.first_index;
  }
}

}  // namespace copse::treeplay
