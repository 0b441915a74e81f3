#include "lib/analysis/surface/bands.h"

namespace copse {

void Bands::add(std::span<const std::uint32_t> from, std::span<const std::uint32_t> to,
                std::span<const std::uint32_t> of) {
  const std::uint32_t id = count();
  for (const std::uint32_t t : of) {
    if (t >= band_of.size()) continue;
    band_of[t] = id;
    triangles.push_back(t);
  }
  first_triangle.push_back(static_cast<std::uint32_t>(triangles.size()));
  vertices.insert(vertices.end(), from.begin(), from.end());
  first_vertex.push_back(static_cast<std::uint32_t>(vertices.size()));
  vertices.insert(vertices.end(), to.begin(), to.end());
  first_vertex.push_back(static_cast<std::uint32_t>(vertices.size()));
}

RingCircle ring_circle(std::span<const Double3> positions, std::span<const std::uint32_t> ring) {
  RingCircle circle;
  if (ring.empty()) return circle;
  // Relative to the first vertex, so that a ring far from the origin keeps its digits.
  const Double3 first = positions[ring[0]];
  Double3 sum;
  for (const std::uint32_t v : ring) sum += positions[v] - first;
  circle.centre = first + sum / static_cast<double>(ring.size());
  for (const std::uint32_t v : ring) circle.radius += distance(positions[v], circle.centre);
  circle.radius /= static_cast<double>(ring.size());
  return circle;
}

}  // namespace copse
