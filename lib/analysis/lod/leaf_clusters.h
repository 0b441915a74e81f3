// leaf_clusters: which leaves become one, and in which order.
//
// Agglomerative clustering: the two patches are merged whose merging displaces the least visible area the
// least (Ward's criterion with the part of each that is seen as its weight, and with turning counted as
// displacing), found among neighbours along a Hilbert-like order of their centres (parallel locally-ordered
// clustering, Meister and Bittner 2018). First inside the groups of leaves that hang on one twig, then of
// groups.
#pragma once

#include "lib/analysis/lod/patch.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

struct PatchMerge {
  std::uint32_t a, b;  // nodes, a < b; patches are 0..n-1, merge i makes node n + i
  double cost;         // visible area x displacement^2, never less than that of the merges that made a and b
};

struct ClusterOptions {
  double largest = 0;        // area beyond which nodes are merged only when nothing else is left; 0: no limit
  double turning = 3;        // how much turning a patch counts beside moving it
  int window = 8;            // neighbours looked at on each side
  double least_seen = 0.02;  // what is not seen at all counts as if this share of it were seen
};

// `group_of`: one a patch; groups are merged to one node each before they are merged with others (to several,
// when `largest` does not allow one). All patches end in one node: n - 1 merges. In an order in which the two
// nodes of a merge always exist before it; not sorted by cost. Deterministic. O(n log n).
std::vector<PatchMerge> cluster_leaves(std::span<const Patch> patches,
                                       std::span<const std::uint32_t> group_of,
                                       const ClusterOptions& options);

}  // namespace copse
