// hole_filling: triangles that stand for the surface that is missing where a limb was cut into another one.
#pragma once

#include "lib/formats/mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// A hole's corner with the side that follows it, and the band across that side; k_none where there is none.
struct HoleCorner {
  std::uint32_t vertex = 0, band = k_none;
};

// Cuts the corner with the shortest diagonal until a triangle is left: corners - 2 triangles, none for fewer
// than three. Where a corner's two sides lie on one band they are part of its ring, and a triangle there
// would close what the next band must run through: those come last. O(n^2).
std::vector<Triangle> fill_polygon(std::span<const Double3> positions, std::vector<HoleCorner> ring);

// A strip of triangles between the sides of a polygon that are on_ring (one a side: from its vertex to the
// next), which must follow one another, and all its other corners: corners - 2 triangles; none where there is
// no such strip. Linear.
std::vector<Triangle> strip_across(std::span<const Double3> positions, std::span<const std::uint32_t> polygon,
                                   std::span<const std::uint8_t> on_ring);

}  // namespace copse
