// attach: which limb grows from which.
#pragma once

#include "lib/analysis/rings/limbs.h"
#include "lib/analysis/trunk/join.h"
#include "lib/analysis/trunk/root.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

struct Attachment {
  std::uint32_t base = k_none;  // the ring that the limb begins with; k_none where there is no such limb
  std::uint32_t ring =
      k_none;      // of the parent limb, alive: the end of the segment that is nearer; k_none: a root
  double gap = 0;  // metres between the base's centre and the parent's surface; < 0 inside it
};

// Attaches every limb by its base (bases[limb], k_none where there is no such limb). The answer has one entry
// a limb and no cycles.
//
// A generator or an artist sets all branches in the same way: on the parent's axis, or on its skin. So the
// offsets from the axis, in radii of the parent, at which most bases of this file lie tell its habit, and
// where twigs cross and several parents are possible, the one that fits it best is taken. Parents that are
// thinner than the child cost more, as do the buried start of a sibling and a gap; to be a root costs
// something as well, most for a high and thin limb. All limbs together are attached in the cheapest way that
// has no cycles (arborescence.h). A limb that is as thick at both ends begins with the one that fits the
// habit better by far. A limb whose base is below the ground and that comes out of it is a root. O(n log n).
//
// `roots`: the limbs that are roots, whatever the geometry says, in any order; where any is named, the ground
// makes no others, so that a branch that droops below it hangs on its tree.
std::vector<Attachment> attach(const Limbs& limbs, const LimbSegments& segments, const Ground& ground,
                               std::span<const std::uint32_t> bases,
                               std::span<const std::uint32_t> roots = {});

}  // namespace copse
