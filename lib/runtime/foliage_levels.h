// foliage_levels: what a runtime makes of foliage cells (digest 001, sections 6 to 8): for every cell a
// factor from its visibility and its distance, from that the number of its leaves, and one list of leaves to
// draw, which holds the first leaves of every cell.
//
// A cell that is drawn coarser shows a subset of what it showed; the survivors are enlarged by `enlargement`
// in area so that the crown keeps its area. No call allocates.
#pragma once

#include "lib/formats/levels/foliage_cells.h"
#include "lib/formats/tree/tree.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace copse {

// How much is left at a distance, 0 to 1, by the ramp of the parameters. Not a number, and distances below
// near: 1.
double ramp_share(const FoliageParameters& parameters, double distance);

// Which views a direction lies between, and how much each counts; weights add up to 1. Continuous across the
// triangles of the views (erratum P11). All 0 when no triangle holds it (there are no views).
struct ViewWeights {
  std::array<std::uint32_t, 3> view{};
  std::array<double, 3> weight{};
};
ViewWeights view_weights(const FoliageCells& cells, const Double3& toward_eye);

struct CellLevel {
  std::uint32_t count = 0;  // the first so many leaves of the cell
  // Of a leaf's area, for all leaves of the cell that can grow so far: FoliageLevels::enlargement says how
  // far a leaf does. Positions scale by its root about the anchor.
  float enlargement = 1;
  float last = 1;  // of the last leaf's area so much is left, over 0: it shrinks before it goes
};

struct LeafSize {
  float area = 1;                                       // m²
  float most = std::numeric_limits<float>::infinity();  // the largest enlargement, 1 or more
};
// Of every leaf its area, and how far it can grow about its centre before it reaches farther than the
// longest half extent of its cell (hazard N15) or out of the crown's hull, as the views of `cells` see it.
// For the loading of a tree. O(vertices x views).
std::vector<LeafSize> leaf_sizes(const Tree& tree, const FoliageCells& cells);

class FoliageLevels {
 public:
  // Keeps a reference to `cells`. `sizes`: one a leaf; none: all leaves are alike and grow freely.
  explicit FoliageLevels(const FoliageCells& cells, std::span<const LeafSize> sizes = {});

  struct Options {
    bool uniform = false;  // visibility counts as 1 everywhere
    // The last leaf of a cell is drawn as large as the fraction of it that is left, so that nothing pops and
    // area is kept between whole numbers of leaves too (the paper leaves that open). Otherwise whole leaves.
    bool shrinking = true;
  };
  // The levels of all cells for an eye at `eye` (relative to the tree's origin). Inside the crown's sphere,
  // and fading out to twice its radius, everything is visible (erratum P18). The survivors of a cell have the
  // area of what distance took (or of all, FoliageParameters::compensation) together: the exact ratio of sums
  // (erratum P4), as far as every leaf can grow. What a cell cannot hold the next ones that have lost leaves
  // do: cells lie in the order of the tree that cut them, so what is next is near. out: one a cell. O(cells +
  // triangles of views); cells with leaves that cannot grow so far are gone through some times.
  void choose(const Double3& eye, const Options& options, std::span<CellLevel> out) const;

  // The leaves that are drawn, cell after cell, each cell's at the sum of the counts before it (an exclusive
  // scan: no two write to the same place). Returns how many; nothing is written when `leaves` is too small.
  std::size_t extract(std::span<const CellLevel> levels, std::span<std::uint32_t> leaves) const;

  // By how much the area of the leaf at this place of the order of cells grows.
  float enlargement(const CellLevel& level, std::size_t place) const {
    return std::max(1.0f, std::min(level.enlargement, most_[place]));
  }

  std::size_t cell_count() const { return cells_->cells.size(); }
  std::size_t leaf_count() const { return cells_->order.size(); }

 private:
  double area(const FoliageCell& cell, double leaves) const;
  double enlarged(const FoliageCell& cell, const CellLevel& level, double factor) const;
  double fill(const FoliageCell& cell, CellLevel& level, double wanted) const;

  const FoliageCells* cells_;
  // By the places of the order: areas summed up from the first of all (one more than leaves); the largest
  // enlargement; and the least of these in its cell up to there.
  std::vector<double> sum_;
  std::vector<float> most_, least_most_;
  Double3 centre_;
  double radius_ = 0;  // of a sphere round all cells
};

}  // namespace copse
