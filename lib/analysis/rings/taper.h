// taper: at which of its ends a limb may begin, going by its thickness alone.
#pragma once

#include "lib/analysis/rings/limbs.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// The rings of each limb that have one neighbour in it or none: its ends. Ascending.
std::vector<std::uint32_t> end_rings(const Limbs& limbs);

// One a ring: 1 where an end may be the base. A tube with two ends begins where it tapers from, if most of
// its steps agree (one flared ring at a tip is no base); otherwise, and for limbs with more ends, the
// thickest end and those of like thickness (tolerances.h) may be it, where a blunt point is as thick as what
// it closes, and the tip of a cone has no thickness. Every limb has at least one. Linear.
std::vector<std::uint8_t> possible_bases(const Limbs& limbs, std::span<const std::uint32_t> ends);

}  // namespace copse
