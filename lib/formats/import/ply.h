// PLY: ascii and both binary formats, any properties in any order, extra elements.
#pragma once

#include "lib/formats/import/mesh_builder.h"

#include <string_view>

namespace copse {

// Reads vertices (x y z, nx ny nz, u v under their usual names), faces, triangle strips and texture names;
// colours and all else are skipped. False: refused, builder.error() says why.
bool read_ply(std::string_view text, MeshBuilder& builder);

}  // namespace copse
