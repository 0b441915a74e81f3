#include "lib/analysis/rings/hole_filling.h"

#include <cstddef>
#include <limits>
#include <utility>

namespace copse {

std::vector<Triangle> fill_polygon(std::span<const Double3> positions, std::vector<HoleCorner> ring) {
  std::vector<Triangle> triangles;
  while (ring.size() >= 3) {
    const std::size_t n = ring.size();
    std::size_t best = 0;
    std::pair<bool, double> least{true, std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i < n && n > 3; ++i) {
      const HoleCorner &last = ring[(i + n - 1) % n], &next = ring[(i + 1) % n];
      const bool on_ring = last.band != k_none && last.band == ring[i].band;
      const std::pair cost(on_ring, distance(positions[last.vertex], positions[next.vertex]));
      if (cost < least) least = cost, best = i;
    }
    const std::size_t last = (best + n - 1) % n;
    triangles.push_back({ring[last].vertex, ring[best].vertex, ring[(best + 1) % n].vertex});
    ring[last].band = k_none;
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(best));
    if (n == 3) break;
  }
  return triangles;
}

std::vector<Triangle> strip_across(std::span<const Double3> positions, std::span<const std::uint32_t> polygon,
                                   std::span<const std::uint8_t> on_ring) {
  const std::size_t n = polygon.size();
  std::size_t begin = n, runs = 0, sides = 0;
  for (std::size_t i = 0; i < n; ++i) {
    sides += on_ring[i];
    if (on_ring[i] && !on_ring[(i + n - 1) % n]) begin = i, ++runs;
  }
  if (runs != 1 || sides + 2 > n) return {};
  // From the side before the run both chains go the same way.
  std::vector<Triangle> triangles;
  std::size_t near = 0, far = 0;
  const std::size_t far_sides = n - sides - 2;
  const auto near_at = [&](std::size_t i) { return polygon[(begin + i) % n]; };
  const auto far_at = [&](std::size_t i) { return polygon[(begin + 2 * n - 1 - i) % n]; };
  while (near < sides || far < far_sides) {
    const std::uint32_t a = near_at(near), b = far_at(far);
    const double along_near = near < sides ? distance(positions[near_at(near + 1)], positions[b])
                                           : std::numeric_limits<double>::infinity();
    const double along_far = far < far_sides ? distance(positions[a], positions[far_at(far + 1)])
                                             : std::numeric_limits<double>::infinity();
    if (along_near <= along_far) {
      triangles.push_back({a, near_at(++near), b});
    } else {
      triangles.push_back({a, far_at(++far), b});
    }
  }
  return triangles;
}

}  // namespace copse
