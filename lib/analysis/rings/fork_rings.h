// fork_rings: the hierarchy of a welded surface that was made of rings, forks and all.
#pragma once

#include "lib/analysis/rings/hierarchy.h"
#include "lib/analysis/surface/bands.h"
#include "lib/analysis/surface/surface.h"

namespace copse {

// All bands that can be read from topology, whatever the triangulation: from the ends of the limbs inward
// (band_growth.h) and along quads (quads.h). Quads are paired in file order first; where that leaves much
// unread (the file was shuffled) by shape alone. O(n log n).
Bands read_bands(const Surface& surface);

// The bands' rings as a hierarchy of radii (ring_walk.h). Vertex and triangle ids are the surface's. There
// are no radii when no ring can be read.
struct RingReading {
  Hierarchy hierarchy;
  double in_bands = 0;  // share of the triangles that lie in bands
  Bands bands;
};
RingReading read_fork_rings(const Surface& surface);

}  // namespace copse
