// merge_groups: fewer, larger leaf groups (digest 000, section 8, idea 1).
#pragma once

#include "lib/formats/vec.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// Until at most `limit` (>= 1) groups are left, the one of the fewest leaves (of several, the lowest) joins
// the group that is nearest to it (of several, the lowest). The joined one keeps the receiver's place.
// `centres`, `leaves`: one a group. Answers for every group the one that its leaves are in afterwards.
// O(n log n) for groups that are spread in space.
std::vector<std::uint32_t> merge_groups(std::span<const Double3> centres,
                                        std::span<const std::uint32_t> leaves, std::uint32_t limit);

}  // namespace copse
