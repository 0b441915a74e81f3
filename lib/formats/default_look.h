// How wood and leaves look of which nothing says how: linear RGB, as Material::diffuse.
#pragma once

#include "lib/formats/vec.h"

namespace copse {

inline constexpr Float3 k_wood_colour{0.23f, 0.165f, 0.115f};
inline constexpr Float3 k_leaf_colour{0.13f, 0.235f, 0.05f};

}  // namespace copse
