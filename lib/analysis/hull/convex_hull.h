// convex_hull: the corners of a point cloud, which are all that a bounding volume depends on; and the frame
// of the line or plane that a flat cloud lies in.
//
// Interior points are dropped by a test of constant cost before the exact hull is built. Where it has more
// corners than `max_corners` (a sphere of points: all are corners), it is that of a kernel, of the corners
// that reach farthest: every point is within `loss` of it. Volumes are then searched on `vertices` and grown
// over `boundary`, and lower bounds found on `vertices` hold for all points, because they are some of them.
#pragma once

#include "lib/analysis/hull/deadline.h"
#include "lib/analysis/hull/point_cloud.h"

#include <array>
#include <cstdint>
#include <vector>

namespace copse {

struct HullEdge {
  std::uint32_t a = 0, b = 0;         // vertices, a < b
  std::uint32_t left = 0, right = 0;  // faces on its two sides; 0 in dimension 2
  friend bool operator==(const HullEdge&, const HullEdge&) = default;
};

struct ConvexHull {
  PointFrame frame;  // all that follows is in cloud coordinates

  // 0: one point; 1: on a line; 2: on a plane; 3. Points within 2^-46 of the size of a line or plane lie on
  // it.
  int dimension = 0;
  // Orthonormal, right-handed: the first `dimension` of them span the line or plane through vertices[0].
  std::array<Double3, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

  // Distinct, in lexicographic order; at least one.
  std::vector<Double3> vertices;
  std::vector<std::uint32_t> indices;               // of the vertices among the caller's points
  std::vector<std::array<std::uint32_t, 3>> faces;  // dimension 3: triangles, counter-clockwise from outside
  std::vector<HullEdge> edges;                      // dimensions 2 and 3, sorted by (a, b)
  double volume = 0, area = 0;                      // dimension 3; 0 otherwise
  double least_volume = 0;  // what it has at least, whatever rounding did to the coordinates and to `volume`

  // Points whose hull holds every point of the cloud: `vertices`, or with a kernel all that are outside it.
  std::vector<Double3> boundary;
  // How far a point can be outside the hull of `vertices`. 0: nothing was given away; infinity: the time was
  // up before it was known.
  double loss = 0;

  DoubleBox box;  // of all points
};

inline constexpr std::size_t k_least_corners = 1000;  // some 10 ms

struct HullOptions {
  std::size_t max_corners = 10'000;  // of more than these the hull is a kernel's
  // Then it is a kernel of the corners that were found by then, at least k_least_corners: passes over all
  // points and that much are not cut short.
  Deadline deadline = {};
};

// Not one byte depends on the order or repetition of the points, except `indices` (the first of equal
// points).
ConvexHull convex_hull(const PointCloud& cloud, const HullOptions& options = {});

// Of a ball that is proven to lie in the hull, about the middle of its vertices: nothing round the points is
// thinner, in any direction, than twice that. 0 where rounding leaves none (thinner than some 1e-7), or flat.
double inner_radius(const ConvexHull& hull);

}  // namespace copse
