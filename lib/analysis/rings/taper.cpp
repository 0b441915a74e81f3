#include "lib/analysis/rings/taper.h"

#include "lib/analysis/surface/tolerances.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace copse {
namespace {

// Whether a point is a lid or a rounded end of what it closes, not the tip of a cone.
bool is_blunt(const Limbs& limbs, std::uint32_t point, std::uint32_t ring) {
  return distance(limbs.centre[point], limbs.centre[ring]) <= k_blunt_point * limbs.diameter[ring];
}

// What a limb with two ends does on the way from its first end to its second.
struct Profile {
  std::array<std::uint32_t, 2> end{k_none, k_none};
  std::uint32_t ends = 0;
  std::int64_t steps = 0;   // between rings of different diameter
  std::int64_t growth = 0;  // steps that thicken less steps that thin
};

// Adds the steps from an end up to the root, which lie on the way from the first end or, backwards, to the
// second. What changes by less than `noise` metres has not changed.
void add_steps(const Limbs& limbs, double noise, Profile& profile, int end) {
  std::uint32_t r = profile.end[end];
  for (std::uint32_t p = limbs.parent_of(r); p != k_none; r = p, p = limbs.parent_of(r)) {
    const double change = limbs.diameter[p] - limbs.diameter[r];
    const double thicker = std::max(limbs.diameter[p], limbs.diameter[r]);
    if (std::abs(change) <= std::max(noise, k_join_tolerance * thicker)) continue;
    ++profile.steps;
    profile.growth += (change > 0) == (end == 0) ? 1 : -1;
  }
}

}  // namespace

std::vector<double> end_thickness(const Limbs& limbs, std::span<const std::uint32_t> ends) {
  std::vector<double> thickness(limbs.rings(), 0);
  for (const std::uint32_t e : ends) {
    const std::uint32_t p = limbs.parent_of(e);
    thickness[e] = limbs.diameter[e];
    if (limbs.diameter[e] == 0 && p != k_none && is_blunt(limbs, e, p)) thickness[e] = limbs.diameter[p];
  }
  for (std::uint32_t r = 0; r < limbs.rings(); ++r) {
    if (limbs.merged_into[r] != k_none || limbs.parent[r] == k_none) continue;
    const std::uint32_t p = limbs.parent_of(r);
    if (limbs.diameter[p] == 0 && is_blunt(limbs, p, r))
      thickness[p] = std::max(thickness[p], limbs.diameter[r]);
  }
  return thickness;
}

std::vector<std::uint32_t> end_rings(const Limbs& limbs) {
  std::vector<std::uint32_t> neighbours(limbs.rings(), 0);
  for (std::uint32_t r = 0; r < limbs.rings(); ++r) {
    if (limbs.merged_into[r] != k_none || limbs.parent[r] == k_none) continue;
    ++neighbours[r];
    ++neighbours[limbs.parent_of(r)];
  }
  std::vector<std::uint32_t> ends;
  for (std::uint32_t r = 0; r < limbs.rings(); ++r) {
    if (limbs.merged_into[r] == k_none && neighbours[r] <= 1) ends.push_back(r);
  }
  return ends;
}

std::vector<std::uint8_t> thick_ends(const Limbs& limbs, std::span<const std::uint32_t> ends) {
  const std::vector<double> thickness = end_thickness(limbs, ends);
  std::vector<double> thickest(limbs.size, 0);
  for (const std::uint32_t e : ends)
    thickest[limbs.limb[e]] = std::max(thickest[limbs.limb[e]], thickness[e]);
  std::vector<std::uint8_t> thick(limbs.rings(), 0);
  for (const std::uint32_t e : ends) thick[e] = thickness[e] * k_like_thickness >= thickest[limbs.limb[e]];
  return thick;
}

std::vector<std::uint8_t> possible_bases(const Limbs& limbs, std::span<const std::uint32_t> ends) {
  std::vector<Profile> profiles(limbs.size);
  DoubleBox box;
  for (const Double3& c : limbs.centre) box.grow(c);
  const double noise = 2 * k_rounding * length(box.extent());
  for (const std::uint32_t e : ends) {
    Profile& profile = profiles[limbs.limb[e]];
    if (profile.ends < 2) profile.end[profile.ends] = e;
    ++profile.ends;
  }
  std::vector<std::uint8_t> possible(limbs.rings(), 0);
  for (Profile& profile : profiles) {
    if (profile.ends != 2) continue;
    add_steps(limbs, noise, profile, 0);
    add_steps(limbs, noise, profile, 1);
    if (profile.steps == 0 || 2 * std::abs(profile.growth) < profile.steps) continue;
    possible[profile.end[profile.growth > 0 ? 1 : 0]] = 1;
    profile.ends = 0;  // decided
  }
  const std::vector<std::uint8_t> thick = thick_ends(limbs, ends);
  for (const std::uint32_t e : ends) {
    if (profiles[limbs.limb[e]].ends != 0) possible[e] = thick[e];
  }
  return possible;
}

}  // namespace copse
