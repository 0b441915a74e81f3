// Signs without rounding, of points in double.
#pragma once

#include "lib/formats/vec.h"

namespace copse {

// Above 0 when p lies on the side of the plane through a, b, c from which they are seen counter-clockwise; 0
// in it.
int exact_side(const Double3& a, const Double3& b, const Double3& c, const Double3& p);

bool exactly_collinear(const Double3& a, const Double3& b, const Double3& c);

}  // namespace copse
