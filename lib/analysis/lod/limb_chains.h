// The trunk as limbs: chains of radii that go on in the same tube. What removes detail from a trunk works
// limb by limb, from the tip of the hierarchy to its root.
#pragma once

#include "lib/formats/tree/tree.h"

#include <cstdint>
#include <vector>

namespace copse {

struct LimbChain {
  std::vector<std::uint32_t> radii;     // first to last, at least two; each the parent of the next
  std::vector<std::uint32_t> segments;  // between them: one less
  std::uint32_t parent = k_none;        // the limb that it grows from: an earlier one; k_none for a root's
};

// Of the children of a radius the thickest one that a segment joins (the first of equals) goes on with the
// limb; every other child begins a limb: with the radius itself when a segment joins them, with the child
// when it is a joint. A radius that no segment touches makes no limb of its own, but what hangs on it finds
// the limb above. Every segment is in exactly one limb. A tree without a hierarchy has no limbs. O(radii).
std::vector<LimbChain> limb_chains(const Tree& tree);

}  // namespace copse
