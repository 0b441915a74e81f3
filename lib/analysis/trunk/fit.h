// fit: how well a hierarchy stands for a surface, as one number to choose between methods by.
#pragma once

#include "lib/analysis/rings/hierarchy.h"
#include "lib/analysis/surface/surface.h"

namespace copse {

struct Fit {
  double distance = 0;  // mean distance of the surface from its generalized cylinders, as a share of its size
  double explained = 0;  // share of the area that some segment explains

  // Smaller is better. What is not explained counts as if it lay a tenth of the surface's size off.
  double cost() const { return distance * explained + 0.1 * (1 - explained); }
};

// The size is the diagonal of the bounding box. Unlike shares of the local radius, which explode at pointed
// tips, this is bounded. O(n log n).
Fit fit_of(const Surface& surface, const Hierarchy& hierarchy);

}  // namespace copse
