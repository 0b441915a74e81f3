// skeleton_limbs: the graph of a curve skeleton as limbs that hang on one another, without spurs.
#pragma once

#include "lib/analysis/skeleton/curve_skeleton.h"

#include <cstdint>
#include <vector>

namespace copse {

// A limb runs along `nodes` (of the skeleton) from its base to its tip. Its first node lies on its parent: it
// is nodes[at] of it; the first limb has no parent.
struct Limb {
  std::vector<std::uint32_t> nodes;
  std::uint32_t parent = 0xffffffffu;
  std::uint32_t at = 0;
};

struct Limbs {
  std::vector<Limb> limbs;               // parents before children
  std::vector<std::uint32_t> kept_node;  // one a skeleton node: itself, or the node that took its spur in
};

// - Cycles are cut where they are thinnest. The skeleton must be connected.
// - The root is the end that is thickest and lowest.
// - At a fork the thickest limb carries on. What does not reach k_spur_reach times the limb's radius out of
// the
//   limb's axis is a spur and becomes part of the limb.
// O(n log n) in nodes and edges.
Limbs find_limbs(const CurveSkeleton& skeleton);

}  // namespace copse
