// foliage_cells_tree: the crown cut into cells: the bottom boxes of a tree of oriented boxes over the leaves.
//
// Gottschalk, Lin, Manocha, "OBBTree" (1996), as digest 001 section 3 asks: a box lies along the principal
// axes of its leaves' area and holds all their vertices; it is cut across its longest axis at the mean of the
// leaves' centres. The box with the longest side is cut next, until there are as many cells as were asked
// for: so no cell is larger than need be, and there are no more of them.
#pragma once

#include "lib/formats/levels/foliage_cells.h"
#include "lib/formats/tree/tree.h"

#include <cstdint>
#include <vector>

namespace copse {

struct CellCut {
  std::vector<FoliageCell> cells;
  std::vector<std::uint32_t> leaves;  // cell after cell; inside one by leaf
};

// At most `most` cells (>= 1); fewer where leaves lie in one place and nothing separates them. Boxes contain
// their leaves' vertices as stored: float32 boxes, tested in double on the stored numbers. O(n log n), no
// recursion.
CellCut cut_cells(const Tree& tree, std::uint32_t most);

}  // namespace copse
