// implied_rings: which rings a subdivision has put between those that shape a limb.
#pragma once

#include "lib/analysis/rings/hierarchy.h"

namespace copse {

// Whether the rings lie at even steps in their own radii, thick or thin, everywhere: nobody lays rings so,
// but tools that cut a surface into squares do (skin modifiers, subdivision, remeshing). A generator's steps
// in radii grow along every limb that tapers.
bool is_evenly_cut(const Hierarchy& hierarchy);

// The hierarchy without the rings that the others imply. What stays: roots, ends, forks and points; rings
// where a limb bends more than on both sides of them, for there a polyline had a corner before it was
// smoothed; and of the rest what is farther than k_implied_tolerance radii, centre and radius together, from
// the straight line between those that stay. Segments of what is left out count to the next radius that
// stays; its vertices belong to no radius. Parents still come before children. O(n log n).
Hierarchy without_implied_rings(const Hierarchy& hierarchy);

}  // namespace copse
