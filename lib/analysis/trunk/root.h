// root: at which end a limb begins.
#pragma once

#include "lib/analysis/rings/limbs.h"
#include "lib/analysis/trunk/join.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// The ground rule of digest 000, section 1.1: a radius whose vertices all have negative y is below the
// ground, and a root. It only means something where y = 0 is the ground: where the trunk dips a little below
// it, not where the model was centred on the origin (tolerances.h: k_ground_depth).
class Ground {
 public:
  Ground(const Limbs& limbs, const LimbSegments& segments, std::span<const Double3> positions);
  bool is_below(std::uint32_t ring) const { return below_[ring] != 0; }
  // Where nothing is below the ground: whether the ring lies on the lowest level of all, and so do ends of
  // other limbs. What several limbs stand on is a floor; what begins inside another limb, as a branch of a
  // fallen trunk does, stands on nothing.
  bool is_floor(std::uint32_t ring) const { return floor_[ring] != 0; }
  // Whether everything hangs down from y = 0.
  bool is_overhead() const { return overhead_; }

 private:
  void find_floor(const Limbs& limbs, const LimbSegments& segments, double height);

  std::vector<std::uint8_t> below_;  // one a ring; all 0 where the rule means nothing
  std::vector<std::uint8_t> floor_;
  bool overhead_ = false;
};

// The ring that each limb begins with; k_none for limb numbers that joining has emptied.
// - A limb that something holds begins at the end that it tapers from (taper.h). Where that leaves a choice:
//   below the ground or on the floor, then where it lies in or against another limb, then the lower one.
// - A limb that nothing holds by such an end stands on an end, whichever way it tapers: one below the ground
// or
//   on the floor, then the lowest; of several that are as low, the thickest. Of more than two ends only those
//   count that are not much thinner than the thickest (tolerances.h), and the tip of a cone only where it is
//   below the ground. What hangs down from y = 0 keeps the end that it tapers from.
// Ties go by position.
std::vector<std::uint32_t> choose_bases(const Limbs& limbs, const LimbSegments& segments,
                                        const Ground& ground);

// The end of a limb that is nearest to each point, plates left out; k_none where there is no limb. O(n) a
// point.
std::vector<std::uint32_t> nearest_ends(const Limbs& limbs, std::span<const Double3> points);

}  // namespace copse
