// quickhull: the hull of points as triangles, by exact signs.
//
// A tetrahedron grows by the farthest point above one of its faces at a time (Barber, Dobkin and Huhdanpaa
// 1996), the farthest of all first: cut short, it is a kernel from which all points are about as little. A
// face in whose plane the new point lies is not seen from it, so that what a flat facet has been cut into
// stays, and no triangle is without area. (CGAL's convex_hull_3 takes such faces for seen and cuts a facet
// anew for each of its corners: n^2 for a drum or a cone.)
#pragma once

#include "lib/analysis/hull/deadline.h"
#include "lib/formats/vec.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace copse {

struct HullTriangles {
  // Indices of points, counter-clockwise from outside. Points within a facet or on an edge of the hull may be
  // among them, and how flat facets are cut depends on the order of the points.
  std::vector<std::array<std::uint32_t, 3>> faces;
  std::vector<std::array<std::uint32_t, 3>> neighbours;  // of each face, across the edges from its corners
  std::vector<std::uint32_t> outside;  // ascending: the points that it does not hold, where it was cut short
};

struct QuickhullLimits {
  std::size_t most = std::numeric_limits<std::size_t>::max();  // corners
  std::size_t least = 4;                                       // that are found however late it is
  Deadline deadline = {};
};

// Empty when all points lie in one plane. Points of about the size 1 (point_cloud.h); repeated ones do no
// harm. Expected O(n log n): some 3 us a corner.
HullTriangles quickhull(std::span<const Double3> points, const QuickhullLimits& limits = {});

}  // namespace copse
