// taper: at which of its ends a limb may begin, going by its thickness alone.
#pragma once

#include "lib/analysis/rings/limbs.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// The rings of each limb that have one neighbour in it or none: its ends. Ascending.
std::vector<std::uint32_t> end_rings(const Limbs& limbs);

// How thick each end is, one a ring (0 for all that are no ends): its own diameter, or of the ring that a
// blunt point closes; the tip of a cone has none.
std::vector<double> end_thickness(const Limbs& limbs, std::span<const std::uint32_t> ends);

// One a ring: 1 where an end is the thickest of its limb or of like thickness (tolerances.h). Linear.
std::vector<std::uint8_t> thick_ends(const Limbs& limbs, std::span<const std::uint32_t> ends);

// One a ring: 1 where an end may be the base. A tube with two ends begins where it tapers from, if most of
// its steps agree (one flared ring at a tip is no base); otherwise, and for limbs with more ends, the
// thickest end and those of like thickness (tolerances.h) may be it. Every limb has at least one. Linear.
std::vector<std::uint8_t> possible_bases(const Limbs& limbs, std::span<const std::uint32_t> ends);

}  // namespace copse
