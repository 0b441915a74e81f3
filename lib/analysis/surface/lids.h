// lids: the flat ends of closed tubes, with or without a vertex in the middle.
#pragma once

#include "lib/formats/mesh.h"
#include "lib/formats/vec.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// An edge a - b between exactly two triangles.
struct SharedEdge {
  std::uint32_t a, b, t, u;
};

struct Lid {
  std::vector<std::uint32_t> rim;        // its vertices, in cyclic order
  std::vector<std::uint32_t> triangles;  // two fewer; with a vertex in the middle as many
  std::uint32_t middle = k_none;
};

// All smooth patches that are discs with at most one inner vertex and have a crease all round: lids, and the
// flat sides of boxes. A patch ends where the cosine between the normals of neighbouring triangles is not
// above `smooth`; as triangles may be turned over, a fold by more than a right angle counts as its
// supplement. `settled`: none, or one a triangle; the edges of those that are not 0 are creases however they
// fold. Patches are in the order of their representatives, so the same input gives the same lids. O(n log n).
std::vector<Lid> find_lids(std::span<const Double3> positions, std::span<const Triangle> triangles,
                           std::span<const SharedEdge> edges, double smooth,
                           std::span<const std::uint8_t> settled = {});

}  // namespace copse
