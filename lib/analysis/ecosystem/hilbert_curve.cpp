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
  GridCell cell;
  std::uint8_t state = 0;
  for (std::uint32_t b = bits; b-- > 0;) {
    const auto wanted = static_cast<std::uint8_t>(index >> (2 * b) & 3);
    for (std::uint32_t quadrant = 0; quadrant < 4; ++quadrant) {
      const Part part = k_parts[state][quadrant];
      if (part.index != wanted) continue;
      cell.x = cell.x << 1 | (quadrant & 1);
      cell.y = cell.y << 1 | quadrant >> 1;
      state = part.state;
      break;
    }
  }
  return cell;
}

}  // namespace copse
