// OFF, the Object File Format of Geomview, as text: OFF, COFF, NOFF, STOFF and their combinations.
#pragma once

#include "lib/formats/import/mesh_builder.h"

#include <string_view>

namespace copse {

// One vertex a line, one face a line; colours are skipped. The binary form and four-dimensional points are
// refused by name. False: refused, builder.error() says why.
bool read_off(std::string_view text, MeshBuilder& builder);

}  // namespace copse
