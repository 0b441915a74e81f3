#include "lib/analysis/boxes/oriented_boxes.h"

#include "lib/analysis/hull/principal_axes.h"

namespace copse {

OrientedBox<double> box_in_axes(std::span<const Double3> points, const Axes& axes) {
  DoubleBox box;  // of the coordinates along the axes
  for (const Double3& p : points) box.grow(Double3{dot(p, axes[0]), dot(p, axes[1]), dot(p, axes[2])});
  const Double3 middle = box.centre();
  const Double3 centre = axes[0] * middle.x + axes[1] * middle.y + axes[2] * middle.z;
  return {centre, axes, box.extent() * 0.5};
}

OrientedBox<double> gaussian_box(const PointCloud& cloud) {
  return box_in_axes(cloud.points, principal_axes(cloud.points).axes);
}

OrientedBox<double> surface_box(const PointCloud& cloud,
                                std::span<const std::array<std::uint32_t, 3>> triangles) {
  return box_in_axes(cloud.points, principal_axes(cloud.points, triangles).axes);
}

OrientedBox<double> hull_surface_box(const ConvexHull& hull) {
  return box_in_axes(hull.boundary, principal_axes(hull.vertices, hull.faces).axes);
}

}  // namespace copse
