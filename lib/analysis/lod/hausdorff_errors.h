// hausdorff_errors: how far what each step of a spectrum draws is from full detail.
//
// The two-sided Hausdorff distance: nothing of full detail is farther from what is drawn, and nothing that is
// drawn is farther from full detail. Bounds on it come from pieces of triangles: no point of a piece is
// farther from a triangle than its farthest corner (the distance to a convex set is convex), and no less far
// from all of them than its corners are; a piece between both bounds is cut into four (as in Guthe, Borodin
// and Klein, "Fast and accurate Hausdorff distance calculation between meshes", 2005). From step to step only
// what lost the triangle that it was near to is looked at again, in bunches where a bunch is near enough.
#pragma once

#include "lib/formats/levels/spectrum.h"

#include <vector>

namespace copse {

// Of each state, steps + 1 of them, metres: 0 as long as nothing has changed, then the largest distance of
// all states so far or more, by no more than k_hausdorff_slack of it or k_hausdorff_floor of the box's
// diagonal, the larger of the two. Where leaves are so large against their distance that more than some 16
// pieces a triangle are asked for, slack and floor are doubled, and again. Where nothing is drawn: the
// largest float. Deterministic; one thread. O(n log n), some microseconds a triangle where leaves cross one
// another.
std::vector<float> hausdorff_errors(const Spectrum& spectrum);

inline constexpr double k_hausdorff_slack = 0.25;
inline constexpr double k_hausdorff_floor = 1e-4;

}  // namespace copse
