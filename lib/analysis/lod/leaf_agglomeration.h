// leaf_agglomeration: two leaves become one bigger, by closed forms alone: but for who can
// leave first (leaf_occlusion.h) no picture is drawn.
//
// Leaf collapse (leaf_collapse.h) for when it must be quick. What is seen of a leaf is what the crown's field
// says of its place (crown_field.h). Each leaf's best host is sought among its neighbours along a
// space-filling curve (as in Meister and Bittner's locally-ordered clustering, 2018); the cheapest fourth is
// merged, and so on. The host grows, about its centre or away from the corner that is farthest from what it
// takes in.
#pragma once

#include "lib/analysis/lod/crown_field.h"
#include "lib/analysis/lod/leaf_elements.h"
#include "lib/analysis/lod/leaf_pieces.h"
#include "lib/analysis/lod/radius_ancestors.h"
#include "lib/analysis/measure/alpha_raster.h"
#include "lib/formats/levels/spectrum.h"
#include "lib/formats/tree/tree.h"

#include <functional>
#include <span>

namespace copse {

// Of the crown's width, out of its hull: no leaf is merged into one that reaches farther.
inline constexpr double k_quick_margin = 0.012;

// What has become of the leaves of a LeafElements.
struct QuickMerges {
  struct Leaf {
    std::uint32_t node, radius, group;
    DrawnLeaf drawn;
  };
  std::vector<Leaf> leaves;         // that are left, along a space-filling curve
  std::vector<std::uint32_t> host;  // of every node, which of them it is part of
};

// Merges all nodes of `elements`, of which none has been merged before, until no more than `triangles` are
// left, or until `good`, asked each time a fourth of the leaves has gone, says no to those that are left.
QuickMerges merge_quickly(const LeafPieces& pieces, const CrownField& field, const RadiusAncestors& ancestors,
                          LeafElements& elements, std::size_t triangles,
                          const std::function<bool(std::span<const QuickMerges::Leaf>)>& good);

// The spectrum of the leaves in `pieces`, which are `tree`'s; what collapse_spectrum says of its elements and
// steps holds here too (`full`: triangles at full detail, of which `pieces` may be what is left). Areas add
// up as exactly; coverage is held by the field's word alone, within about a tenth. Deterministic; one thread.
// O(n log n), some hundred nanoseconds a triangle and merge.
Spectrum agglomerate_leaves(const Tree& tree, const Looks& looks, const LeafPieces& pieces, std::size_t full);

}  // namespace copse
