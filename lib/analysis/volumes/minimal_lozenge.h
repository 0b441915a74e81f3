// minimal_lozenge: the lozenge (rectangle swept by a ball) of least volume.
//
// Frame, sides, height and radius are searched together (swept_search.h).
#pragma once

#include "lib/analysis/volumes/bounded_fit.h"
#include "lib/formats/volume.h"

#include <span>

namespace copse {

// `points`: hull vertices in canonical order, |p| about 1 or less. Never worse than gaussian_lozenge,
// minimal_capsule or the minimal ball, all of which it tries. Some 8 ms for 300 points, and what the minimal
// capsule takes.
BoundedFit<Lozenge<double>> minimal_lozenge(std::span<const Double3> points);

// The same when the minimal capsule of the points is known.
BoundedFit<Lozenge<double>> minimal_lozenge(std::span<const Double3> points, const Capsule<double>& capsule);

}  // namespace copse
