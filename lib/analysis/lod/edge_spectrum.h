// What half-edge collapses leave: any state of the mesh, and all of them as a spectrum, replayed from the
// records.
#pragma once

#include "lib/analysis/lod/edge_collapse.h"
#include "lib/formats/levels/part_triangles.h"
#include "lib/formats/levels/spectrum.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// The spectrum of the collapses: an element a triangle and a form that it takes. `radius_of`: of every
// triangle, or empty. O(triangles that change).
Spectrum edge_spectrum(const PartTriangles& mesh, const EdgeCollapses& collapses,
                       std::span<const std::uint32_t> radius_of);

// The triangles that are left after the first `count` collapses, with the triangle of the mesh that each was.
struct CollapsedState {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> source;
};
CollapsedState collapsed_state(const PartTriangles& mesh, const EdgeCollapses& collapses, std::size_t count);

}  // namespace copse
