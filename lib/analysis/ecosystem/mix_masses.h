// How much of a mix each of its types can have: the mass of every type's density field (density_field.h), all
// counted in one pass over their grid. Density, the sum of the shares and the ground are asked once a point,
// whatever the number of types; no field is kept, because sixteen of 2048 x 2048 cells would be 800 MB.
//
// O(points * (maps of the sum + types)); memory O(rows * types), and the distances to the marked pixels of
// every map that a rule has.
#pragma once

#include "lib/analysis/ecosystem/density_field.h"
#include "lib/formats/random.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

struct MixPart {
  const PlacementRules* rules = nullptr;  // density and share_total are those of the first part
  Random random;                          // of its clusters, as for make_field
};

struct MixMasses {
  std::vector<double> masses;  // of every part: total() of what make_field makes
  std::uint64_t points = 0;    // that were looked at, one for all parts that are sampled there
};

// Rows in parallel, summed in order.
MixMasses mix_masses(std::span<const MixPart> parts, const PlantedArea& area, const TerrainGround& ground,
                     std::uint32_t columns, std::uint32_t rows);

}  // namespace copse
