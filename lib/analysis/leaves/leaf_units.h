// leaf_units: which pieces of foliage are one leaf in an artist's eyes.
//
// Cards that cross in one centre, and cards laid back to back, are drawn to look like one leaf from several
// sides. They are pieces of their own, but pair beyond doubt: as many triangles (those that a damaged file
// has twice or that have no area not counted), about the same reach, the same centre to a thousandth of their
// size, and most pieces with as many triangles do the same.
#pragma once

#include "lib/analysis/leaves/pieces.h"
#include "lib/formats/mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

struct LeafUnits {
  std::vector<std::uint32_t> of;  // one a piece: its leaf, numbered by first triangle; k_none: no leaf
  std::uint32_t count = 0;
};

// `welded`: one representative a position (weld.h). `is_leaf`: one a piece. O(n log n).
LeafUnits leaf_units(const Mesh& mesh, std::span<const std::uint32_t> welded, const PieceTriangles& pieces,
                     std::span<const std::uint8_t> is_leaf);

}  // namespace copse
