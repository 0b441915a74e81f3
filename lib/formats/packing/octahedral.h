// Unit vectors as two numbers: the octahedron unfolded onto a square (Meyer, Süßmuth, Sußner, Stamminger,
// Greiner, "On floating-point normal vectors", 2010). 8 bits each err by 0.95 degrees at most.
#pragma once

#include "lib/formats/vec.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace copse {

inline constexpr int k_octahedral_limit = 127;  // numbers run from -127 to 127

using Octahedral = std::array<std::int32_t, 2>;

inline Octahedral to_octahedral(const Double3& n) {
  const double sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
  double u = sum > 0 ? n.x / sum : 0, v = sum > 0 ? n.y / sum : 0;
  if (n.z < 0) {
    const double folded = (1 - std::abs(v)) * (u < 0 ? -1 : 1);
    v = (1 - std::abs(u)) * (v < 0 ? -1 : 1), u = folded;
  }
  return {static_cast<std::int32_t>(std::lround(u * k_octahedral_limit)),
          static_cast<std::int32_t>(std::lround(v * k_octahedral_limit))};
}

inline Float3 from_octahedral(const Octahedral& o) {
  double u = double(o[0]) / k_octahedral_limit, v = double(o[1]) / k_octahedral_limit;
  const double z = 1 - std::abs(u) - std::abs(v);
  if (z < 0) {
    const double unfolded = (1 - std::abs(v)) * (u < 0 ? -1 : 1);
    v = (1 - std::abs(u)) * (v < 0 ? -1 : 1), u = unfolded;
  }
  return to_float(normalized({u, v, z}));
}

}  // namespace copse
