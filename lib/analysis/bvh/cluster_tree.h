// cluster_tree: clusters joined bottom up, pair by pair, by the smallest joint box.
//
// A new cluster may be joined again at once, so the tree is binary and follows the density of the items
// instead of being balanced. Looking for the nearest among all others would cost O(n^2); clusters are kept
// in the order of a Hilbert curve instead, each looks at its neighbours there, and pairs that choose one
// another are joined, round by round.
//
// Source: digest 002, section 3.4 (the dissertation's section 3.6, second policy), which describes and does
// not measure it; the rounds: D. Meister and J. Bittner, "Parallel locally-ordered clustering for bounding
// volume hierarchy construction" (2018).
#pragma once

#include "lib/analysis/bvh/box_tree.h"

namespace copse {

// boxes: finite, none empty, fewer than 2^31. "Smallest" is the surface of the joint box; ties are broken by
// place, so the same boxes give the same tree. Expected O(n log n).
BoxTree cluster_tree(std::span<const DoubleBox> boxes);

}  // namespace copse
