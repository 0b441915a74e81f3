// curve_skeleton: what a method of skeletonisation hands over: a graph of points inside the surface.
#pragma once

#include "lib/analysis/surface/lists.h"
#include "lib/formats/vec.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace copse {

struct CurveSkeleton {
  std::vector<Double3> points;
  std::vector<double> radii;  // rough: from the contour or from the vertices that collapsed there
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;  // ascending, each once, first < second
  std::vector<std::uint32_t> node_of;  // one a vertex of the surface: the point that it belongs to
  std::uint32_t base = 0;              // the point at the lowest end of the surface
  Lists triangles;                     // one list a point: triangles of the surface about it
};

}  // namespace copse
