#include "lib/analysis/rings/limb_ends.h"

#include "lib/analysis/surface/bands.h"
#include "lib/analysis/surface/tolerances.h"
#include "lib/analysis/surface/welded_tolerances.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace copse {

std::vector<SharedEdge> LimbEnds::edges() const {
  std::vector<SharedEdge> edges;
  for (std::uint32_t t = 0; t < surface_.triangles.size(); ++t) {
    for (std::size_t e = 0; e < 3; ++e) {
      const std::uint32_t n = surface_.across[t][e];
      if (n != k_none && n > t)
        edges.push_back({surface_.triangles[t][e], surface_.triangles[t][(e + 1) % 3], t, n});
    }
  }
  return edges;
}

const std::vector<Lid>& LimbEnds::lids(double smooth) {
  for (const auto& [angle, lids] : lids_) {
    if (angle == smooth) return lids;
  }
  return lids_.emplace_back(smooth, find_lids(surface_.positions, surface_.triangles, edges(), smooth))
      .second;
}

std::vector<Lid> LimbEnds::lids_beside(double smooth, std::span<const std::uint8_t> settled) const {
  std::vector<Lid> lids = find_lids(surface_.positions, surface_.triangles, edges(), smooth, settled);
  std::erase_if(lids, [&](const Lid& lid) { return settled[lid.triangles[0]] != 0; });
  return lids;
}

bool LimbEnds::is_round(std::span<const std::uint32_t> ring) const {
  const Double3 origin = surface_.positions[ring[0]];
  Double3 twice_area;
  double way_round = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Double3 a = surface_.positions[ring[i]] - origin;
    const Double3 b = surface_.positions[ring[(i + 1) % ring.size()]] - origin;
    twice_area += cross(a, b);
    way_round += distance(a, b);
  }
  const double k = static_cast<double>(ring.size());
  const double of_regular = 1 / (4 * k * std::tan(std::numbers::pi / k));  // area over way round squared
  return length(twice_area) / 2 >= k_ring_roundness * of_regular * way_round * way_round;
}

bool LimbEnds::may_close(const Lid& lid, Lids which) const {
  if (which == Lids::round && !is_round(lid.rim)) return false;
  const RingCircle c = ring_circle(surface_.positions, lid.rim);
  return lid.middle == k_none || distance(surface_.positions[lid.middle], c.centre) < k_cap_height * c.radius;
}

bool LimbEnds::is_lid_corner(std::uint32_t vertex) {
  if (lid_corner_.empty()) {
    lid_corner_.assign(surface_.positions.size(), 0);
    std::vector<std::uint32_t> corners;
    for (const Lid& lid : lids(k_lid_smooth_cosines[0])) {
      if (lid.middle != k_none) continue;
      corners.clear();
      for (const std::uint32_t t : lid.triangles) {
        corners.insert(corners.end(), surface_.triangles[t].begin(), surface_.triangles[t].end());
      }
      std::ranges::sort(corners);
      for (std::size_t i = 1; i < corners.size(); ++i) {
        if (corners[i] == corners[i - 1]) lid_corner_[corners[i]] = 1;
      }
    }
  }
  return lid_corner_[vertex] != 0;
}

}  // namespace copse
