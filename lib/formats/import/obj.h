// Wavefront OBJ.
#pragma once

#include "lib/formats/import/companions.h"
#include "lib/formats/import/mesh_builder.h"

#include <string_view>

namespace copse {

// Reads v, vt, vn, f, o, g, usemtl and mtllib; lines, points and free-form geometry are skipped with a
// warning. False: refused, builder.error() says why.
bool read_obj(std::string_view text, const Companions& companions, MeshBuilder& builder);

}  // namespace copse
