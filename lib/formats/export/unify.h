// From corners with three indices each to vertices with one: what GPUs, PLY and glTF want.
#pragma once

#include "lib/formats/mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// A vertex of its own for every distinct combination of position, normal and texture coordinate, in the order
// of first use.
struct UnifiedMesh {
  std::vector<std::uint32_t> position;  // of each vertex: index into Mesh::positions
  std::vector<std::uint32_t> texcoord;  // index into Mesh::texcoords, k_none where a corner has none
  std::vector<Float3> normal;           // of unit length; empty when no corner has one
  bool has_texcoords = false;
  std::vector<Triangle> triangles;  // indices into the vertices, in the order of `which`
};

// Unifies the triangles `which` of a mesh whose indices are all in range. Normals are made unit vectors;
// where some corners have one, a corner without a usable one gets its triangle's geometric normal.
UnifiedMesh unify(const Mesh& mesh, std::span<const std::uint32_t> which);

// The triangles of each part, in the order of the mesh; one part for all when the mesh names none.
std::vector<std::vector<std::uint32_t>> triangles_by_part(const Mesh& mesh);

}  // namespace copse
