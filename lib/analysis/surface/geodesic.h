// geodesic: how far it is over the surface to every vertex.
#pragma once

#include "lib/analysis/surface/lists.h"
#include "lib/analysis/surface/surface.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// The triangles round each vertex, ascending.
Lists triangles_of_vertices(const Surface& surface);

// The distance over the surface from the nearest of `sources`, one a vertex, in the unit of the positions;
// infinite where the surface does not lead. Fast marching (Kimmel and Sethian 1998) where the wave crosses a
// triangle between two of its edges, the way along an edge elsewhere: never shorter than the straight line
// between two points of a flat surface, never longer than along its edges. No vertex but the sources is
// nearer than all its neighbours. O(n log n).
std::vector<double> geodesic_distance(const Surface& surface, const Lists& triangles_of,
                                      std::span<const std::uint32_t> sources);

}  // namespace copse
