// foliage_levels: what a runtime makes of foliage cells (digest 001, sections 6 to 8): for every cell a
// factor from its visibility and its distance, from that the number of its leaves, and one list of leaves to
// draw, which holds the first leaves of every cell.
//
// A cell that is drawn coarser shows a subset of what it showed; the survivors are enlarged by `enlargement`
// in area so that the crown keeps its area. No call allocates.
#pragma once

#include "lib/formats/levels/foliage_cells.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// How much is left at a distance, 0 to 1. `linear`: full up to near, `least` from far on, straight between
// (what the paper built). `power`: equation 1, distance^(-log_h 2) with distances in units of near.
enum class FoliageRamp { linear, power };

// Not a number, and distances below near: 1.
double ramp_share(const FoliageParameters& parameters, double distance, FoliageRamp ramp);

// Which views a direction lies between, and how much each counts; weights add up to 1. Continuous across the
// triangles of the views (erratum P11). All 0 when no triangle holds it (there are no views).
struct ViewWeights {
  std::array<std::uint32_t, 3> view{};
  std::array<double, 3> weight{};
};
ViewWeights view_weights(const FoliageCells& cells, const Double3& toward_eye);

struct CellLevel {
  std::uint32_t count = 0;  // the first so many leaves of the cell
  float enlargement = 1;    // of a leaf's area; positions scale by its root about the anchor
  float last = 1;           // of the last leaf's area so much is left, over 0: it shrinks before it goes
};

class FoliageLevels {
 public:
  // Keeps a reference to `cells`.
  explicit FoliageLevels(const FoliageCells& cells);

  struct Options {
    FoliageRamp ramp = FoliageRamp::linear;
    bool uniform = false;  // visibility counts as 1 everywhere
    // The last leaf of a cell is drawn as large as the fraction of it that is left, so that nothing pops and
    // area is kept between whole numbers of leaves too (the paper leaves that open). Otherwise whole leaves.
    bool shrinking = true;
  };
  // The levels of all cells for an eye at `eye` (relative to the tree's origin). Inside the crown's sphere,
  // and fading out to twice its radius, everything is visible (erratum P18). out: one a cell. O(cells +
  // triangles of views).
  void choose(const Double3& eye, const Options& options, std::span<CellLevel> out) const;

  // The leaves that are drawn, cell after cell, each cell's at the sum of the counts before it (an exclusive
  // scan: no two write to the same place). Returns how many; nothing is written when `leaves` is too small.
  std::size_t extract(std::span<const CellLevel> levels, std::span<std::uint32_t> leaves) const;

  std::size_t cell_count() const { return cells_->cells.size(); }
  std::size_t leaf_count() const { return cells_->order.size(); }

 private:
  const FoliageCells* cells_;
  Double3 centre_;
  double radius_ = 0;  // of a sphere round all cells
};

}  // namespace copse
