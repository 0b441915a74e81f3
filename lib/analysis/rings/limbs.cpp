#include "lib/analysis/rings/limbs.h"

#include <utility>

namespace copse {

void Limbs::append(const RingMeasure& measure, std::uint32_t ring_parent, RadiusSource ring_source,
                   std::span<const std::uint32_t> ring_vertices) {
  limb.push_back(size);
  merged_into.push_back(k_none);
  band.push_back(ring_parent == k_none ? k_none : rings());
  centre.push_back(measure.centre);
  diameter.push_back(measure.diameter);
  normal.push_back(measure.normal);
  parent.push_back(ring_parent);
  source.push_back(ring_source);
  vertices.insert(vertices.end(), ring_vertices.begin(), ring_vertices.end());
  first_vertex.push_back(static_cast<std::uint32_t>(vertices.size()));
}

RingMeasure measure_ring(std::span<const Double3> positions, std::span<const std::uint32_t> ring) {
  if (ring.empty()) return {};
  const double share = 1.0 / static_cast<double>(ring.size());
  // Relative to one of the points, so that a ring far from the origin keeps its digits.
  const Double3& origin = positions[ring[0]];
  Double3 mean;
  for (const std::uint32_t v : ring) mean += (positions[v] - origin) * share;
  RingMeasure measure{origin + mean, 0, {}};
  for (const std::uint32_t v : ring) {
    measure.diameter += 2 * share * length(positions[v] - origin - mean);
  }
  if (ring.size() < 3 || !(measure.diameter > 0)) return measure;
  // In radii: products of lengths neither overflow nor vanish.
  const auto arm = [&](std::uint32_t v) { return (positions[v] - origin - mean) / measure.diameter; };
  for (std::size_t i = 0; i < ring.size(); ++i) {
    measure.normal += cross(arm(ring[i]), arm(ring[(i + 1) % ring.size()]));
  }
  measure.normal = normalized(measure.normal, {0, 0, 0});
  return measure;
}

void reroot(Limbs& limbs, std::uint32_t ring) {
  std::uint32_t parent = k_none, band = k_none;
  for (std::uint32_t r = ring; r != k_none;) {
    const std::uint32_t next = limbs.parent_of(r);
    limbs.parent[r] = parent;
    band = std::exchange(limbs.band[r], band);
    parent = std::exchange(r, next);
  }
}

void merge_rings(Limbs& limbs, std::uint32_t copy, std::uint32_t ring) {
  reroot(limbs, copy);
  limbs.merged_into[copy] = ring;
}

}  // namespace copse
