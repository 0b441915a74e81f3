// oriented_boxes: boxes in given axes, and in the axes of a spread.
//
// Source: digest 002, section 4.3 a to d (S. Gottschalk, M. Lin, D. Manocha, "OBBTree", SIGGRAPH 1996),
// always re-centred (4.3.b). Lower bounds are not known here: minimal_box has one.
#pragma once

#include "lib/analysis/hull/convex_hull.h"
#include "lib/analysis/hull/frame.h"
#include "lib/formats/volumes/volume.h"

namespace copse {

// The smallest box with these axes round the points, of which there is at least one. O(n).
OrientedBox<double> box_in_axes(std::span<const Double3> points, const Axes& axes);

// In the principal axes of the points.
OrientedBox<double> gaussian_box(const PointCloud& cloud);

// In the principal axes of the triangles' surface, round all points.
OrientedBox<double> surface_box(const PointCloud& cloud,
                                std::span<const std::array<std::uint32_t, 3>> triangles);

// In the principal axes of the hull's surface, or where it has none (a flat cloud) of its vertices.
OrientedBox<double> hull_surface_box(const ConvexHull& hull);

}  // namespace copse
