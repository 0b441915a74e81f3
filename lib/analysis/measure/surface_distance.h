// surface_distance: how far two surfaces are from one another.
#pragma once

#include "lib/analysis/measure/drawn_mesh.h"

#include <cstdint>

namespace copse {

struct SurfaceDistance {
  double mean = 0, rms = 0, max = 0;  // metres, over the area of the surface that is measured from
};

struct SurfaceDistances {
  SurfaceDistance from_level;   // of points of the level to the source: what stands where nothing was
  SurfaceDistance from_source;  // of points of the source to the level: what is gone
};

// From `samples` points spread over each surface by area (stratified, from a random stream of `seed`) to the
// nearest point of the other's triangles: exact for each point, so `max` is a lower bound on the one-sided
// Hausdorff distance. A surface without triangles is infinitely far from the other one; no points give 0.
// Deterministic. Cost: O((triangles + samples) log triangles).
SurfaceDistances surface_distance(const DrawnMesh& source, const DrawnMesh& level,
                                  std::uint32_t samples = 4000, std::uint64_t seed = 0);

}  // namespace copse
