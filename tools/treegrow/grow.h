// Growth: species -> skeleton.
#pragma once

#include "tools/treegrow/skeleton.h"
#include "tools/treegrow/species.h"

#include <cstdint>

namespace copse::grow {

inline constexpr std::uint64_t k_most_nodes = 20'000'000;  // points that stems are drawn through

struct Growth {
  double height = 0;        // m; 0: the species'
  double twigs = 1;         // factor on the number of stems of the last level (of blades of grass)
  double branches = 1;      // the same for the levels between the trunk and the last
  std::uint32_t trees = 1;  // side by side
  std::uint64_t most_nodes = k_most_nodes;
};

// A species that would have more than `most_nodes` nodes is not grown on: Skeleton::too_large says so.
// Cost: O(stems x nodes). The same seed gives the same boughs whatever `twigs` is.
Skeleton grow(const Species& species, const Growth& growth, std::uint64_t seed);

}  // namespace copse::grow
