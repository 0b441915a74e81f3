// cell_visibility: how much of each cell of a crown is seen from where (digest 001, section 5, algorithm 1).
#pragma once

#include "lib/analysis/measure/alpha_raster.h"
#include "lib/analysis/measure/view_sphere.h"
#include "lib/formats/levels/foliage_cells.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// For every cell and view: `total`, the pixels that the cell alone would cover, and `visible`, those in which
// nothing of another cell is in front of it. As the paper's four passes with LEQUAL count them: what ties at
// a pixel is visible for each cell that ties. But two passes do for all cells: one for the depth of the whole
// crown, one that looks each cell up in it (erratum P7: O(views x leaves)). Alpha-tested texels are holes.
//
// `cell_of`: one a triangle, ascending. Views frame the mesh, `size` pixels a side; in parallel, the result
// does not depend on the number of threads. Counts are cells x views.
std::vector<CellVisibility> cell_visibility(const DrawnMesh& mesh, const Looks& looks,
                                            std::span<const std::uint32_t> cell_of, std::uint32_t cells,
                                            std::span<const Double3> views, int size);

}  // namespace copse
