// quads: which two triangles were one quad, and the closed strips of quads.
#pragma once

#include "lib/analysis/surface/bands.h"
#include "lib/analysis/surface/surface.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

enum class QuadOrder : std::uint8_t {
  shape,  // the pairs that are most nearly rectangles, first
  file,   // neighbours in the file: exporters cut a quad into two consecutive triangles; then by shape
};

// The partner of each triangle, k_none for those without. Only triangles whose `taken` is k_none are paired.
// O(n log n).
std::vector<std::uint32_t> pair_quads(const Surface& surface, std::span<const std::uint32_t> taken,
                                      QuadOrder order);

// The partner of each triangle where every one is half of a quad: neighbours in the file, however slanted,
// then by shape. Empty where one is left over, which is mostly seen at once. O(n log n).
std::vector<std::uint32_t> pair_all_quads(const Surface& surface);

// Adds the bands that closed strips of quads make: of strips that cross, the one with the shorter way round,
// as round a limb is shorter than along it. Strips pass through quads, so no vertex of any valence stops
// them.
void add_quad_bands(const Surface& surface, std::span<const std::uint32_t> partner, Bands& bands);

}  // namespace copse
