#include "lib/formats/ecosystem/terrain_normal.h"

namespace copse {

Double3 terrain_normal(const Terrain& t, std::uint32_t column, std::uint32_t row) {
  Double3 normal;
  for (std::uint32_t r = row == 0 ? 0 : row - 1; r <= row && r + 1 < t.rows; ++r)
    for (std::uint32_t c = column == 0 ? 0 : column - 1; c <= column && c + 1 < t.columns; ++c) {
      // Cell a b / d e is cut from a to e.
      const Double3 a = t.vertex(c, r), e = t.vertex(c + 1, r + 1);
      if (c == column || r != row) normal += cross(t.vertex(c, r + 1) - a, e - a);
      if (c != column || r == row) normal += cross(e - a, t.vertex(c + 1, r) - a);
    }
  if (!(length(normal) > 0)) return {0, 1, 0};
  normal = normalized(normal);
  return normal.y < 0 ? -normal : normal;
}

}  // namespace copse
