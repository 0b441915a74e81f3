// Lines and discs as they are drawn: flat, facing the eye.
#pragma once

#include "lib/formats/vec.h"

#include <array>
#include <cstdint>

namespace copse::treeplay {

using Tint = std::array<std::uint8_t, 4>;  // sRGB

struct FlatLine {
  Float3 from, to;
  float radius_from = 0, radius_to = 0;
  Tint tint{};
};

struct FlatDisc {
  Float3 centre;
  float radius = 0;
  Tint tint{};
};

}  // namespace copse::treeplay
