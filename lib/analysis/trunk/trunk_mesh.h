// The trunk of one model, welded: what the hierarchy is recovered from.
#pragma once

#include "lib/formats/mesh.h"

#include <cstdint>
#include <vector>

namespace copse {

struct TrunkMesh {
  std::vector<Double3> positions;     // welded: no two closer than the weld tolerance
  std::vector<Triangle> triangles;    // indices into positions; none degenerate (three distinct indices)
  std::vector<std::uint32_t> source;  // the mesh triangle that each came from
  // Adjacency before welding: the connected piece of the *unwelded* mesh that each triangle belongs to. Tells
  // tubes that merely touch (same position, separate pieces) from tubes that share a ring. One a triangle.
  std::vector<std::uint32_t> piece;
};

}  // namespace copse
