#include "lib/analysis/rings/ring_circles.h"

#include <cmath>

namespace copse {

RingCircles::RingCircles(const Hierarchy& hierarchy, std::size_t vertices)
    : hierarchy_(hierarchy), ring_of_(vertices, k_none) {
  for (std::uint32_t r = 0; r + 1 < hierarchy.first_vertex.size(); ++r) {
    if (hierarchy.radii[r].source == RadiusSource::surface) continue;
    for (std::uint32_t i = hierarchy.first_vertex[r]; i < hierarchy.first_vertex[r + 1]; ++i) {
      ring_of_[hierarchy.ring_vertices[i]] = r;
    }
  }
}

std::optional<std::array<double, 3>> RingCircles::along(const Triangle& triangle, std::uint32_t child) const {
  std::array<double, 3> at{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t ring = ring_of_[triangle[i]];
    if (ring == k_none || (ring != child && ring != hierarchy_.radii[child].parent)) return {};
    at[i] = ring == child ? 1 : 0;
  }
  return at;
}

double off_circle(const Double3& point, const RadiusNode& parent, const RadiusNode& child, double at) {
  const double radius = (parent.diameter + at * (child.diameter - parent.diameter)) / 2;
  return std::abs(distance(point, parent.centre + (child.centre - parent.centre) * at) - radius);
}

}  // namespace copse
