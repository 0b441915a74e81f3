#include "lib/analysis/trunk/root.h"

#include "lib/analysis/rings/taper.h"
#include "lib/analysis/surface/tolerances.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace copse {
namespace {

// How deep an end lies in another limb, in radii of that limb from its axis; infinite in the open. Where it
// meets the end of another limb, both could begin there: that says nothing.
class Contact {
 public:
  Contact(const Limbs& limbs, const LimbSegments& segments, std::span<const std::uint32_t> ends)
      : limbs_(limbs), segments_(segments), is_end_(limbs.rings(), 0) {
    for (const std::uint32_t e : ends) is_end_[e] = 1;
  }

  double operator()(std::uint32_t end) {
    const double radius = limbs_.diameter[end] / 2;
    segments_.tree.near(limbs_.centre[end], k_contact_reach * radius, radius / 2, limbs_.limb[end],
                        k_candidates, found_);
    for (const Nearness& near : found_) {
      const std::uint32_t ring = limbs_.alive(segments_.rings[near.segment][near.t < 0.5 ? 0 : 1]);
      if (is_end_[ring] &&
          distance(limbs_.centre[ring], limbs_.centre[end]) <= std::max(radius, limbs_.diameter[ring] / 2)) {
        continue;
      }
      return near.distance / std::max(near.radius, radius / 2);
    }
    return std::numeric_limits<double>::infinity();
  }

 private:
  const Limbs& limbs_;
  const LimbSegments& segments_;
  std::vector<std::uint8_t> is_end_;
  std::vector<Nearness> found_;
};

}  // namespace

Ground::Ground(const Limbs& limbs, std::span<const Double3> positions)
    : below_(limbs.rings(), 0), floor_(limbs.rings(), 0) {
  DoubleBox box;
  for (const std::uint32_t v : limbs.vertices) box.grow(positions[v]);
  const double height = box.extent().y;
  bool any_below = false;
  if (!box.empty() && -box.min.y <= k_ground_depth * height) {
    for (std::uint32_t r = 0; r < limbs.rings(); ++r) {
      below_[r] = !limbs.ring(r).empty() &&
                  std::ranges::all_of(limbs.ring(r), [&](std::uint32_t v) { return positions[v].y < 0; });
      any_below |= below_[r] != 0;
    }
  }
  if (!any_below) find_floor(limbs, height);
}

void Ground::find_floor(const Limbs& limbs, double height) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Double3& c : limbs.centre) lowest = std::min(lowest, c.y);
  std::vector<std::uint32_t> standing;
  for (const std::uint32_t e : end_rings(limbs)) {
    const double level = std::min(k_same_level * height, k_ground_level * limbs.diameter[e] / 2);
    if (limbs.centre[e].y - lowest <= level) standing.push_back(e);
  }
  const bool several = std::ranges::any_of(
      standing, [&](std::uint32_t e) { return limbs.limb[e] != limbs.limb[standing.front()]; });
  if (!several) return;
  for (const std::uint32_t e : standing) floor_[e] = 1;
}

std::vector<std::uint32_t> choose_bases(const Limbs& limbs, const LimbSegments& segments,
                                        const Ground& ground) {
  const std::vector<std::uint32_t> ends = end_rings(limbs);
  const std::vector<std::uint8_t> possible = possible_bases(limbs, ends);
  std::vector<std::uint32_t> choices(limbs.size, 0);
  for (const std::uint32_t e : ends) choices[limbs.limb[e]] += possible[e];
  Contact contact(limbs, segments, ends);
  using Rank = std::tuple<bool, double, double>;  // lower is better
  std::vector<Rank> best(limbs.size);
  std::vector<std::uint32_t> base(limbs.size, k_none);
  for (const std::uint32_t e : ends) {
    const std::uint32_t limb = limbs.limb[e];
    if (!possible[e]) continue;
    Rank rank;
    if (choices[limb] > 1) rank = {!ground.is_below(e) && !ground.is_floor(e), contact(e), limbs.centre[e].y};
    if (base[limb] == k_none || rank < best[limb]) best[limb] = rank, base[limb] = e;
  }
  return base;
}

}  // namespace copse
