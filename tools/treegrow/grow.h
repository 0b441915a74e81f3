// Growth: species -> skeleton.
#pragma once

#include "tools/treegrow/skeleton.h"
#include "tools/treegrow/species.h"

#include <cstdint>

namespace copse::grow {

struct Growth {
  double height = 0;        // m; 0: the species'
  double twigs = 1;         // factor on the number of stems of the last level
  std::uint32_t trees = 1;  // side by side
};

// Cost: O(stems x nodes). The same seed gives the same tree whatever `twigs` is, but for the twigs.
Skeleton grow(const Species& species, const Growth& growth, std::uint64_t seed);

}  // namespace copse::grow
