// Copies the normals and texture coordinates that a set of triangles uses, each once, in the order of first
// use.
#pragma once

#include "lib/formats/array.h"
#include "lib/formats/mesh.h"
#include "lib/formats/tree/tree.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace copse {

class CornerColumns {
 public:
  // Of at most so many triangles.
  CornerColumns(const Mesh& mesh, std::size_t triangles);

  // The normal and texture indices of a mesh triangle's corners, into the columns below; vertices stay 0.
  CornerTriangle corners(std::uint32_t mesh_triangle);

  std::vector<Float3> normals;
  std::vector<Float2> texcoords;

 private:
  const Mesh& mesh_;
  std::vector<std::uint32_t> stored_normal_, stored_texcoord_;
};

// One material for all, or one each: fills either `constant` or `each`.
void store_materials(std::vector<std::uint32_t> materials, std::uint32_t& constant,
                     Array<std::uint32_t>& each);

}  // namespace copse
