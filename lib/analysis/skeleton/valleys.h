// valleys: a surface, cut along the sharp closed lines where united tubes meet.
#pragma once

#include "lib/analysis/surface/bands.h"
#include "lib/analysis/surface/surface.h"

#include <cstdint>
#include <vector>

namespace copse {

// The surface, cut along its valleys: each piece has vertices of its own.
struct CutSurface {
  Surface surface;                      // positions, triangles and across only
  std::vector<std::uint32_t> origin;    // one a vertex: that of the whole surface
  std::vector<std::uint8_t> at_valley;  // one a vertex
  std::vector<std::uint32_t> piece;     // one a triangle
  std::vector<std::uint32_t> valley;    // one an edge of each triangle: its valley or k_none
  std::uint32_t pieces = 0, valleys = 0;
};

// Valleys are closed lines of edges that bend inward by an angle of at least that sine and have no corner on
// a ring of `bands` that keep their number of vertices; a crack between two pieces is one as well. Triangles
// keep their numbers. O(n log n).
CutSurface cut_along_valleys(const Surface& surface, const Bands& bands, double sine);

}  // namespace copse
