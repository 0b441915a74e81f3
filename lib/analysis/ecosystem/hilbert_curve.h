// The Hilbert curve over a square grid: neighbours on the curve are neighbours in the plane, and every
// quarter, sixteenth, ... of the square is one run of it.
//
// Source: Skilling, "Programming the Hilbert curve" (2004); in the plane it is a table of four orientations.
#pragma once

#include <array>
#include <cstdint>

namespace copse {

struct GridCell {
  std::uint32_t x = 0, y = 0;
};

// Of cell (x, y) of 2^bits x 2^bits; bits <= 31. The curve of `bits` refines that of fewer: the index of the
// cell (x >> 1, y >> 1) on the coarser one is the index >> 2.
std::uint64_t hilbert_index(std::uint32_t x, std::uint32_t y, std::uint32_t bits);
GridCell hilbert_cell(std::uint64_t index, std::uint32_t bits);

// Cells 256 * tile to 256 * tile + 255 at once, for going through a whole curve; bits >= 4.
std::array<GridCell, 256> hilbert_tile(std::uint64_t tile, std::uint32_t bits);

}  // namespace copse
