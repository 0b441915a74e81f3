// The ladder of one limb: the tubes that stand for it, from its own triangles to nothing, with what each
// costs.
#pragma once

#include "lib/analysis/lod/limb_shape.h"

#include <cstdint>
#include <vector>

namespace copse {

struct LimbRung {
  std::vector<std::uint32_t> kept;  // rings, ascending, first and last among them; empty: nothing is left
  std::uint32_t sides = 0;          // 2: a ribbon; 1: one triangle
  std::uint32_t triangles = 0;
  double cost = 0;   // square metres of silhouette
  double bound = 0;  // metres
};

// `forks`: for every ring whether other limbs grow there (such a ring counts twice). `full`: triangles of
// full detail. `vanish`: see TrunkRadiiOptions. Rungs by strictly descending triangles, below `full`; costs
// grow at least in proportion to what they save (a convex ladder); the last one is nothing. O(rings log
// rings).
std::vector<LimbRung> limb_ladder(const LimbShape& shape, const std::vector<std::uint8_t>& forks,
                                  std::uint32_t full, double vanish);

}  // namespace copse
