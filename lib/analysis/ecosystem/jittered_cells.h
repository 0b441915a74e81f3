// The placement of the thesis: a grid of cells with at least as many cells as there are instances, at most
// one instance a cell, each type walking the grid at its ideal distance with a random margin.
//
// Source: digest 000, section 2.4, erratum E5 (the walk begins anew for every type), hazards H26 and H27. The
// walk keeps a real position, so that types do not bunch up; a cell that is taken gives way to the first free
// one after it; what passes the last cell goes into random free cells, drawn without replacement. Expected
// time O(cells).
#pragma once

#include "lib/formats/random.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// A share of the ideal distance, so below a half: the walk never goes backwards.
inline constexpr double k_walk_margin = 0.45;

struct CellGrid {
  std::uint64_t columns = 0, rows = 0;
  std::uint64_t cells() const { return columns * rows; }
};

// A grid of at least so many cells over width x depth: those of the largest square cells that fit in, so over
// a square c x c, c the smallest integer with c * c >= instances. Where no two such cells stand side by side
// each has all of that side, and there are as many as instances. Less than 5 * instances cells; none for
// none. O(sqrt(instances)).
CellGrid cells_over(double width, double depth, std::uint64_t instances);

struct CellPlaces {
  std::vector<std::uint64_t> cells;  // of type 0's instances, of type 1's, ...
  std::uint64_t displaced = 0;       // found their cell taken
  std::uint64_t at_random = 0;       // were left when the walk had passed the last cell
};

// Counts are kept; precondition: they add up to `cells` at most. Type t draws from random.fork(t).
CellPlaces place_in_cells(std::span<const std::uint64_t> counts, std::uint64_t cells, const Random& random);

}  // namespace copse
