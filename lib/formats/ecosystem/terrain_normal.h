// The normal of a terrain at one of its vertices, for shading: the mean of the triangles round it, each by
// its area. (What stands on the terrain stands along the normal of its triangle, ground.h of the analysis.)
#pragma once

#include "lib/formats/ecosystem/ecosystem.h"

#include <cstdint>

namespace copse {

// Length 1, y >= 0; +Y where the triangles have no area. O(1).
Double3 terrain_normal(const Terrain& terrain, std::uint32_t column, std::uint32_t row);

}  // namespace copse
