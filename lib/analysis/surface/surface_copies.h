// surface_copies: surfaces that are there twice, corner for corner.
#pragma once

#include "lib/analysis/surface/surfaces.h"
#include "lib/analysis/surface/trunk_mesh.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace copse {

// A surface whose triangles, whichever way they face, have exactly the corners that those of an earlier one
// have, or are halves of the same quads, cut by the other diagonal: shells for two-sided wood, and parts that
// an exporter wrote twice.
struct SurfaceCopies {
  std::vector<std::uint32_t> original;  // one a surface: the first that it copies; k_none for most
  // (triangle of a copy, the triangle that it lies on), ascending.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> triangles;
};

// Of surfaces of as many triangles and vertices in the very same box, each is compared with the first. O(n
// log n).
SurfaceCopies find_surface_copies(const TrunkMesh& mesh, const Surfaces& surfaces);

}  // namespace copse
