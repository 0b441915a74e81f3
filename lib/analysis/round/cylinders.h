// cylinders: about the line of least squares, re-centred, and of least volume with a bound of how small any
// can be.
//
// Source: digest 002, section 4.6 (as corrected). Minimal: over all directions of the axis, the smallest
// circle round the projected points times the width along it. Bound: branch and bound over cells of
// directions; when the axis turns by t, the width of a pair of points with difference e is at least cos t e .
// u - sin t |e across u|, and the circle round the points that the middle's circle touches shrinks by at most
// 1 - cos t of its radius and sin t times half their extent along the axis.
#pragma once

#include "lib/analysis/hull/convex_hull.h"
#include "lib/analysis/hull/deadline.h"
#include "lib/analysis/volumes/bounded_fit.h"
#include "lib/formats/volumes/volume.h"

#include <limits>

namespace copse {

// All in cloud coordinates. Where the points have no length along the axis, the cylinder has some 2^-28: its
// direction must be told by its ends (grid_axis.h).
Cylinder<double> line_fit_cylinder(const PointCloud& cloud);

// In the same direction, about the smallest circle round the projected points. Never larger.
Cylinder<double> recentred_cylinder(const PointCloud& cloud);

struct MinimalCylinderOptions {
  // Stop when the volume is proven to be at most (1 + gap) times the least. What the first search has missed
  // is found on the way. Infinity: that search alone, and the hull's volume as bound.
  double gap = 0.001;
  std::size_t max_cells = 200'000;
  Deadline deadline = {};  // of the search too, which never ends without a cylinder
};

// Flat clouds: a disc across their plane, or about a line a tube without radius; bound 0.
BoundedFit<Cylinder<double>> minimal_cylinder(const ConvexHull& hull,
                                              const MinimalCylinderOptions& options = {});

// The smallest cylinder with this direction.
Cylinder<double> cylinder_along(std::span<const Double3> points, const Double3& direction);

}  // namespace copse
