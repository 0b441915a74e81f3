// How the leaves of a tree are packed: which of them are one shape, where a frame says enough, which rule
// makes their normals. The encoder's half of pack_leaves.h.
#pragma once

#include "lib/formats/packing/pack_leaves.h"

#include <cstdint>
#include <span>

namespace copse {

inline constexpr double k_leaf_tolerance = 1;  // steps: a vertex of a leaf that is stored as a frame
inline constexpr double k_leaf_normal_tolerance = 0.02;  // radians: a normal that follows from a rule

// `order`: the leaves as they are to be stored, each group's together. Every vertex is within
// k_leaf_tolerance of where it was, or on the nearest place of the grid; every normal within
// k_leaf_normal_tolerance, or the nearest octahedral one. Linear in the leaves.
PackedLeaves plan_leaves(const Tree& tree, const PackGrid& grid, const PackedTrunk& trunk,
                         std::span<const std::uint32_t> order);

}  // namespace copse
