// limb_leaves: where along a limb its leaves hang.
#pragma once

#include "lib/analysis/lod/limb_chains.h"

#include <vector>

namespace copse {

// Of every limb and each of its rings the area of the leaves, square metres, of which it is the nearest of
// the limb that bears their group; an empty list for a limb that bears none. What is nearest is sought among
// some rings evenly spread along the limb and then round the best of these, so on a limb that comes back to
// itself it may be another one that is near. `centres`: absolute_centres(tree). O(leaves sqrt(rings of a
// limb)).
std::vector<std::vector<double>> limb_leaves(const Tree& tree, const std::vector<LimbChain>& limbs,
                                             const std::vector<Double3>& centres);

}  // namespace copse
