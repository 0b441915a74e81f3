// The ladder of one limb: the tubes that stand for it, from its own triangles to nothing, with what each
// costs.
#pragma once

#include "lib/analysis/lod/limb_shape.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// Which ring of a limb goes next (digest 000, section 5.7 and table 5.1).
enum class RemovalOrder {
  silhouette,       // the one whose loss costs the least area of silhouette
  angle,            // the one at which the axis bends least: the angle between its two segments
  projected_angle,  // the same, as seen from level directions all round, on the mean
  diameter,         // the thinnest
};

struct LimbRung {
  std::vector<std::uint32_t> kept;  // rings, ascending, first and last among them; empty: nothing is left
  std::uint32_t sides = 0;          // 2: a ribbon; 1: one triangle
  std::uint32_t triangles = 0;
  double cost = 0;   // square metres of silhouette
  double bound = 0;  // metres
};

// The leaves of a limb. When its axis goes elsewhere they would hang in the air, so others are made of them
// that do not: worse ones, for good.
struct HangingLeaves {
  std::span<const double> area;  // square metres, one entry a ring (limb_leaves); none: no leaves
  double hold = 0;               // metres that the axis may go aside under them
};

// `forks`: for every ring whether other limbs grow there (such a ring counts twice). `full`: triangles of
// full detail. `vanish`, `order`: see TrunkRadiiOptions; whatever the order, costs and bounds are those of
// what is left out. `share`: what the limb has of the whole trunk's silhouette, 0 to 1: the larger, the
// dearer is a ribbon, which is not seen from its edge. Rungs by strictly descending triangles, below `full`;
// costs grow at least in proportion to what they save (a convex ladder); the last one is nothing. O(rings log
// rings).
std::vector<LimbRung> limb_ladder(const LimbShape& shape, const std::vector<std::uint8_t>& forks,
                                  std::uint32_t full, double vanish,
                                  RemovalOrder order = RemovalOrder::silhouette,
                                  const HangingLeaves& leaves = {}, double share = 0);

}  // namespace copse
