// foliage_pruning: fewer and larger leaves, cell by cell, the least visible cells first.
//
// Gumbau, Chover, Remolar, "Interactive simplification of vegetation on graphics hardware" (digest 001),
// after Cook and Halstead's stochastic pruning: a cell shows the first m leaves of a random order; what is
// left is enlarged so that its area stays (errata P4, P6: lengths grow by the root of the exact ratio of
// areas of this cell).
#pragma once

#include "lib/analysis/measure/alpha_raster.h"
#include "lib/formats/levels/foliage_cells.h"
#include "lib/formats/levels/spectrum.h"
#include "lib/formats/tree/tree.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

struct PruningOptions {
  std::uint32_t cells = 256;  // at most
  int views = 42;             // at least
  int resolution = 256;       // pixels of a view's side
  std::uint64_t seed = 0;
  double near = 0, far = 0;  // metres; 0, 0: 2 and 40 times the crown's radius
  double least = 0.05;
  double half_distance = 2;  // h of equation 1, > 1
  double largest_enlargement = 64;
  // What a runtime is to do (erratum P19); the spectrum does not depend on these.
  FoliageParameters::Distance distance = FoliageParameters::Distance::cell;
  FoliageParameters::Compensation compensation = FoliageParameters::Compensation::distance;
  FoliageParameters::Ramp ramp = FoliageParameters::Ramp::linear;
};

// Cells, order, views, visibility and parameters. Inside a cell the order is stratified: the leaves in the
// order of a space-filling curve through the cell's box, taken by the scrambled bit reversal of their ranks,
// so that every prefix is spread evenly over the cell; its scramble is a random stream of the cell's own.
// Deterministic.
FoliageCells prune_foliage(const Tree& tree, const Looks& looks, const PruningOptions& options);

// How many leaves each cell shows at a fraction (hazard N13): ceil, at least 1.
std::uint32_t shown_leaves(std::uint32_t count, double fraction);
// The same for all cells; and when fewer leaves are to be left than there are cells, some cells show none, in
// a stratified order of the cells too: for each number of them evenly over the crown. At least one leaf is
// left.
std::vector<std::uint32_t> shown_cells(std::span<const FoliageCell> cells, double fraction);

// The same as a spectrum, all cells alike (001's uniform mode): at each step the fraction of the leaves that
// are left is 2^(1/4) smaller, each enlarged about its centre so that the crown keeps its area
// (leaf_enlargement). Ends with one leaf.
Spectrum pruned_spectrum(const Tree& tree, const FoliageCells& foliage);

}  // namespace copse
