// Whether trees stand where a density field asks for them: how many it asks for in its denser and in its
// thinner parts, how many stand there, and how full of discs that ground is.
#pragma once

#include "lib/analysis/ecosystem/density_field.h"
#include "lib/analysis/ecosystem/spacing.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace copse {

struct DensityShare {
  double from = 0, to = 0;                // shares of the largest density
  double asked = 0;                       // trees
  std::uint64_t got = 0, unhindered = 0;  // those that stand there, and that would if there were room for all
  double covered = 0;  // of that ground, by discs whose centres are there; above 1 when they reach out of it
};

// Parts of about an eighth of the field's mass each, cut by the density of cells, the thinnest first; what is
// as dense is in one part. None of a field that is as dense everywhere. `unhindered`: where a tree would
// stand if nothing were in its way; asked of all trees, from many threads. O(cells + trees + feet + discs).
std::vector<DensityShare> density_shares(const DensityField& field, std::uint64_t trees,
                                         const std::function<GroundPlace(std::uint64_t)>& unhindered,
                                         std::span<const GroundPlace> feet, std::span<const Disc> discs);

// What the histogram is off by: the sum over all parts of |got - asked|, as a share of what is asked for.
double histogram_error(std::span<const DensityShare> shares);

// Trees that stand in other parts than they would if there were room for all. Chance has no part in it.
std::uint64_t out_of_their_part(std::span<const DensityShare> shares);

}  // namespace copse
