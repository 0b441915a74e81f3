// stray_roots: what was found to stand in the air.
//
// A twig that nothing was found to hold is a tree of its own, rooted where it should hang: all its triangles
// are explained, so that no other figure shows it.
#pragma once

#include "lib/analysis/rings/hierarchy.h"

#include <cstdint>
#include <vector>

namespace copse {

// The roots, ascending, whose trees are small beside another one (k_small_tree of its radii or less) and
// begin within the box round that one's radii, above its root by more than k_above_ground of its height. O(n
// log n) where trees stand side by side, at most trees squared.
std::vector<std::uint32_t> stray_roots(const Hierarchy& hierarchy);

inline constexpr double k_small_tree = 0.25, k_above_ground = 0.05;

}  // namespace copse
