// STL, text and binary. The format repeats every corner's coordinates; those that are equal bit by bit (and
// -0, which equals 0) become one vertex, so that the mesh has connectivity. Facet normals and attribute bytes
// are skipped: the winding says which side is out.
#pragma once

#include "lib/formats/import/mesh_builder.h"

#include <cstdint>
#include <span>

namespace copse {

// Each `solid` of a text file is an object. False: refused, builder.error() says why.
bool read_stl(std::span<const std::uint8_t> bytes, MeshBuilder& builder);

}  // namespace copse
