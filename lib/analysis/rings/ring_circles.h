// ring_circles: generalized cylinders whose ends stand as the rings do that they were read from.
#pragma once

#include "lib/analysis/rings/hierarchy.h"
#include "lib/formats/mesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace copse {

// Rings need not stand at right angles to the axis: ends are cut level, generators shear their tubes. Between
// two rings that were read from the mesh (RadiusSource::ring or point), a triangle whose corners lie on them
// tells how far along the axis each of its points is, whatever the angle.
class RingCircles {
 public:
  // `hierarchy` must outlive this; `vertices` is one more than the largest of its ring_vertices, or more.
  // Memory: 4 bytes a vertex.
  RingCircles(const Hierarchy& hierarchy, std::size_t vertices);

  // How far along the segment of radius `child` the corners of a triangle are: 0 on the parent's ring, 1 on
  // the child's. Nothing where one lies on neither.
  std::optional<std::array<double, 3>> along(const Triangle& triangle, std::uint32_t child) const;

 private:
  const Hierarchy& hierarchy_;
  std::vector<std::uint32_t> ring_of_;  // one a vertex; k_none
};

// Metres between a point and the circle that lies `at` of the way between two radii, in a plane through the
// point: | |p - centre| - radius |. An upper bound of its distance from the generalized cylinder.
double off_circle(const Double3& point, const RadiusNode& parent, const RadiusNode& child, double at);

}  // namespace copse
