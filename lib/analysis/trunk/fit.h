// fit: how well a hierarchy stands for a surface, as one number to choose between methods by.
#pragma once

#include "lib/analysis/rings/hierarchy.h"
#include "lib/analysis/surface/surface.h"

namespace copse {

struct Fit {
  // Mean distance of the surface's vertices from its generalized cylinders, at right angles to their axes and
  // weighted by area, as a share of its size: 0 where rings are regular, whatever their number of sides and
  // however they stand (ring_circles.h).
  double distance = 0;
  double explained = 0;  // share of the area that some segment explains

  // Smaller is better. What is not explained counts as if it lay a tenth of the surface's size off.
  double cost() const { return distance * explained + 0.1 * (1 - explained); }
};

// The hierarchy is of this surface alone: its ring_vertices are ids of surface.positions, its segment_of has
// an entry a triangle of it. The size is the diagonal of the bounding box. Unlike shares of the local radius,
// which explode at pointed tips, this is bounded. O(n).
Fit fit_of(const Surface& surface, const Hierarchy& hierarchy);

}  // namespace copse
