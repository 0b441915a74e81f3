// winding: which triangles must be turned so that all are wound alike, and outward.
#pragma once

#include "lib/formats/mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// One a triangle: 1 where its winding must be turned. Triangles of one piece that share an edge which no
// third one of it has are wound alike; what hangs together so is wound outward: it encloses a positive volume
// once each of its borders is closed towards that border's middle. Where that is no volume (a flat sheet),
// most triangles stay as they are. What cannot be wound alike (a Moebius strip) is so as far as its
// triangles' order has it. O(n log n).
std::vector<std::uint8_t> turned_triangles(std::span<const Double3> positions,
                                           std::span<const Triangle> triangles,
                                           std::span<const std::uint32_t> piece);

}  // namespace copse
