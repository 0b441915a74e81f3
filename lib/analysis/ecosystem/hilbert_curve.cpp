#include "lib/analysis/ecosystem/hilbert_curve.h"

#include <array>

namespace copse {
namespace {

// For each of the four orientations of the curve (as is, transposed, turned by 180 degrees, both): which part
// of the curve quadrant 2 y + x is, and the orientation inside it.
struct Part {
  std::uint8_t index, state;
};
constexpr std::array<std::array<Part, 4>, 4> k_parts{{
    {{{0, 1}, {3, 3}, {1, 0}, {2, 0}}},
    {{{0, 0}, {1, 1}, {3, 2}, {2, 1}}},
    {{{2, 2}, {1, 2}, {3, 1}, {0, 3}}},
    {{{2, 3}, {3, 0}, {1, 3}, {0, 2}}},
}};

struct Descent {
  GridCell cell;
  std::uint8_t state = 0;
};

constexpr Descent descend(std::uint64_t index, std::uint32_t bits, std::uint8_t state) {
  Descent d{{}, state};
  for (std::uint32_t b = bits; b-- > 0;) {
    const auto wanted = static_cast<std::uint8_t>(index >> (2 * b) & 3);
    for (std::uint32_t quadrant = 0; quadrant < 4; ++quadrant) {
      const Part part = k_parts[d.state][quadrant];
      if (part.index != wanted) continue;
      d.cell.x = d.cell.x << 1 | (quadrant & 1);
      d.cell.y = d.cell.y << 1 | quadrant >> 1;
      d.state = part.state;
      break;
    }
  }
  return d;
}

constexpr std::uint32_t k_tile_bits = 4;

constexpr auto k_tiles = [] {
  std::array<std::array<GridCell, 256>, 4> tiles{};
  for (std::uint8_t state = 0; state < 4; ++state)
    for (std::size_t i = 0; i < 256; ++i) tiles[state][i] = descend(i, k_tile_bits, state).cell;
  return tiles;
}();

}  // namespace

std::uint64_t hilbert_index(std::uint32_t x, std::uint32_t y, std::uint32_t bits) {
  std::uint64_t index = 0;
  std::uint8_t state = 0;
  for (std::uint32_t b = bits; b-- > 0;) {
    const Part part = k_parts[state][2 * (y >> b & 1) + (x >> b & 1)];
    index = index << 2 | part.index;
    state = part.state;
  }
  return index;
}

GridCell hilbert_cell(std::uint64_t index, std::uint32_t bits) {
  return descend(index, bits, 0).cell;
}

std::array<GridCell, 256> hilbert_tile(std::uint64_t tile, std::uint32_t bits) {
  const Descent at = descend(tile, bits - k_tile_bits, 0);
  std::array<GridCell, 256> cells = k_tiles[at.state];
  for (GridCell& c : cells) {
    c.x |= at.cell.x << k_tile_bits;
    c.y |= at.cell.y << k_tile_bits;
  }
  return cells;
}

}  // namespace copse
