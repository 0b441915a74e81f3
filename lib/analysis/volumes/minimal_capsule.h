// minimal_capsule: the capsule of least volume.
//
// The minimal capsule is not the smallest projected circle with half spheres: with the direction given, the
// radius trades against the length. Direction, position and radius are searched together (swept_search.h).
#pragma once

#include "lib/analysis/volumes/bounded_fit.h"
#include "lib/formats/volume.h"

#include <span>

namespace copse {

// `points`: hull vertices in canonical order, |p| about 1 or less. Never worse than least_squares_capsule,
// projected_circle_capsule or the minimal ball, both of which it tries. Some 3 ms for 300 points.
BoundedFit<Capsule<double>> minimal_capsule(std::span<const Double3> points);

}  // namespace copse
