// ring_places: where the rings that are left of a limb stand so that the tube through them lies as near as it
// can to all of them.
//
// A polyline through every second point of a crooked line cuts all of its corners on one side; moved by least
// squares it runs between them.
#pragma once

#include "lib/formats/vec.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

struct LimbAxis {
  std::span<const Double3> centres;  // of all rings, metres
  std::span<const double> along;     // metres along the limb, ascending; as many
  std::span<const double> radii;     // metres; as many
};

// By how much each of the rings `kept` (ascending, two at least; the first and the last one among them)
// moves: least squares over all rings of the distance from the axis that goes straight from one that is kept
// to the next, each with its share of the length. Those that are `fixed` (one entry a kept ring; not 0) stay,
// the first and the last one always. In steps of a sixteenth of the ring's radius, so that what is far from
// where the limb changes stays as it is. No ring is farther from the axis than the farthest one was: where it
// would be, all move half or a quarter of the way, or stay. O(rings).
std::vector<Double3> ring_shifts(const LimbAxis& axis, std::span<const std::uint32_t> kept,
                                 std::span<const std::uint8_t> fixed);

}  // namespace copse
