// leaf_enlargement: by how much the leaves that are left of a pruned crown grow, so that it keeps its area
// (digest 001, section 8).
//
// The leaves of a cell grow alike, by the exact ratio of areas (errata P4, P6), as far as they fit: none by
// more than the largest enlargement, farther from its centre than the longest half extent of its cell (hazard
// N15), or out of the crown's hull. What a cell cannot hold it shares with the next one, as if both were one
// cell, what both cannot with the next two, and so on up to the whole crown: cells lie in the order of the
// tree that cut them, so what is next is near.
#pragma once

#include "lib/formats/levels/foliage_cells.h"
#include "lib/formats/levels/part_triangles.h"
#include "lib/formats/tree/tree.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

class LeafEnlargement {
 public:
  // `part`: leaf_triangles(tree). Keeps references to `foliage`. O(vertices).
  LeafEnlargement(const Tree& tree, const PartTriangles& part, const FoliageCells& foliage);

  // Of every place in foliage.order what the area of that leaf is multiplied by, 1 or more, when the first
  // shown[c] leaves of each cell c are drawn; 0 where it is not drawn. The areas add up to those of all
  // leaves unless even the whole crown cannot hold them. O(leaves log cells).
  std::vector<double> factors(std::span<const std::uint32_t> shown) const;

 private:
  struct Leaf {
    double area = 0, reach = 0;  // m², m from its centre
    double most = 1;             // factor at which it leaves the crown's hull, or the largest of all
  };
  // Some cells that are next to one another, which hold their area together.
  struct Run {
    std::uint32_t first = 0, last = 0;  // cells
    double half = 0, area = 0;          // longest half extent; of all of its leaves
  };
  void measure(const Tree& tree, const PartTriangles& part);
  void make_runs();
  void fill(const Run& run, std::span<const std::uint32_t> shown, std::vector<double>& factors) const;
  template <class F>
  void for_each_shown(const Run& run, std::span<const std::uint32_t> shown, F&& f) const;

  const FoliageCells& foliage_;
  std::vector<Leaf> leaves_;  // in the order of foliage.order
  std::vector<Run> runs_;     // single cells first, the whole crown last
};

}  // namespace copse
