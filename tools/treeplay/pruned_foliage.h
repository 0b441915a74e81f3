// --lod foliage: a crown by its cells, each as visible and as far as it is (digest 001).
#pragma once

#include "lib/formats/levels/foliage_cells.h"
#include "lib/formats/tree/tree.h"
#include "lib/runtime/foliage_levels.h"
#include "lib/runtime/tree_geometry.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace copse::treeplay {

class PrunedFoliage {
 public:
  // `cells` must be those of `tree`. `geometry`: make_geometry(tree); it gets vertices of their own for the
  // leaves, which share none.
  PrunedFoliage(const Tree& tree, FoliageCells cells, TreeGeometry& geometry);

  struct Frame {
    std::vector<DrawVertex> leaves;  // the vertices from first_leaf_vertex() on
    std::vector<std::uint32_t> indices;
    std::vector<DrawRange> ranges;
    std::size_t leaf_count = 0;
  };
  // `eye` relative to the tree's origin.
  void select(const TreeGeometry& geometry, const Double3& eye, Frame& out) const;
  std::uint32_t first_leaf_vertex() const { return first_vertex_; }

 private:
  std::unique_ptr<const FoliageCells> cells_;
  FoliageLevels levels_;
  std::vector<Float3> centres_;                      // of the leaves
  std::vector<std::vector<std::uint32_t>> leaf_of_;  // of every range's triangles; empty for the trunk's
  std::uint32_t first_vertex_ = 0;
};

}  // namespace copse::treeplay
