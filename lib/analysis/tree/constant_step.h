// Offsets whose steps are all alike are stored as that one number: the thesis' constant k and segment factor.
#pragma once

#include <cstdint>
#include <vector>

namespace copse {

// The step when all offsets have the same positive one, otherwise 0.
inline std::uint32_t constant_step(const std::vector<std::uint32_t>& offsets) {
  if (offsets.size() < 2) return 0;
  const std::uint32_t step = offsets[1] - offsets[0];
  for (std::size_t i = 1; i + 1 < offsets.size(); ++i) {
    if (offsets[i + 1] - offsets[i] != step) return 0;
  }
  return step;
}

}  // namespace copse
