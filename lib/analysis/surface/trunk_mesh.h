// The trunk of one model, welded: what the hierarchy is recovered from.
//
// Exporters repeat vertices along texture and normal seams, and generators push tubes into one another
// without joining them. So positions are welded, but only within a surface: pieces are sewn into one surface
// where their boundary edges coincide (seams, flat-shaded faces, tubes laid end to end, a branch whose base
// ring is a ring of its parent), and pieces that merely touch keep vertices of their own.
#pragma once

#include "lib/formats/mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

struct TrunkMesh {
  std::vector<Double3> positions;     // welded: within a surface no two closer than the weld tolerance
  std::vector<Triangle> triangles;    // indices into positions; none degenerate (three distinct indices)
  std::vector<std::uint32_t> source;  // the mesh triangle that each came from, ascending
  // Adjacency before welding: the connected piece of the *unwelded* mesh that each triangle belongs to,
  // numbered by first triangle. Surfaces are what shared vertices connect; a surface is one piece or several.
  std::vector<std::uint32_t> piece;
  // The triangle's place in the file, for reading quads, where that is not `source` (spatial_order.h); else
  // empty.
  std::vector<std::uint32_t> file_order{};
};

// The triangles whose `is_trunk` entry is not 0 (one a mesh triangle). Those with fewer than three distinct
// vertices after welding are left out. `tolerance`: metres, applied everywhere; negative: weld_tolerances()
// decides place by place. `file_order`: where the mesh's triangles were in the file, empty where they still
// are. Deterministic; O(n) plus a sort of the edges at which pieces touch.
TrunkMesh make_trunk_mesh(const Mesh& mesh, std::span<const std::uint8_t> is_trunk, double tolerance = -1,
                          std::span<const std::uint32_t> file_order = {});

}  // namespace copse
