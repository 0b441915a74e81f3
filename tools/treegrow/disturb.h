// Breaks that are done to a finished mesh: faces and vertices, whatever they belong to.
#pragma once

#include "lib/formats/mesh.h"
#include "tools/treegrow/breaks.h"

#include <cstdint>

namespace copse::grow {

void disturb(Mesh& mesh, const Breaks& breaks, std::uint64_t seed);

}  // namespace copse::grow
