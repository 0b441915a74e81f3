// Whether discs together cover a rectangle, and where it is open if they do not.
//
// What they leave open has a corner, and that is one of the rectangle, a crossing of a circle with its
// border, or a crossing of two circles. So these are all that is looked at, each against every other disc:
// the answer is exact, for discs of any sizes, but for openings of a part in 1e9 of a radius, which count as
// covered. O(discs^3) where they cover it, and less where they do not.
#pragma once

#include "lib/analysis/ecosystem/density_field.h"
#include "lib/analysis/ecosystem/spacing.h"

#include <optional>
#include <span>

namespace copse {

// Discs grown by `growth`; what is on a circle is not in its disc.
bool is_covered(const Patch& patch, std::span<const Disc> discs, double growth);

// None: it is covered. Otherwise the middle of all open corners, which lies in the opening where there is one
// and it is small beside the discs round it.
std::optional<GroundPlace> open_middle(const Patch& patch, std::span<const Disc> discs, double growth);

}  // namespace copse
