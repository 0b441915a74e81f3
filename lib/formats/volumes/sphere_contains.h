// Whether a sphere of float32 numbers contains a point or another sphere: the exact answer, as if computed
// with unlimited precision. Points on the surface are inside.
//
// Doubles decide all but the few cases that lie within their rounding error of the surface; those are decided
// by exact expansions (J. R. Shewchuk, "Adaptive precision floating-point arithmetic", 1997). float32 inputs
// keep every product within the range of double, so nothing can overflow or underflow.
#pragma once

#include "lib/formats/vec.h"

namespace copse {

// Finite arguments, radius >= 0.
bool sphere_contains(const Float3& centre, float radius, const Float3& point);

// The second sphere lies inside the first.
bool sphere_contains(const Float3& centre, float radius, const Float3& inner_centre, float inner_radius);

}  // namespace copse
