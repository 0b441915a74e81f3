// join: tubes that are laid end to end become one limb.
//
// A generator often ends one tube and starts the next in the same ring, with another number of sides or
// turned a little, so that sewing (sew.h) does not see it. The two rings are one radius: "two joined
// cylinders share one radius" (digest 000, section 1.1).
#pragma once

#include "lib/analysis/rings/limbs.h"
#include "lib/analysis/trunk/segment_tree.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// One segment for every ring with a parent, and one without length for a limb that is a single ring. rings[s]
// are the rings at a and b.
struct LimbSegments {
  explicit LimbSegments(const Limbs& limbs);
  std::vector<std::array<std::uint32_t, 2>> rings;
  SegmentTree tree;
};

// Merges every end ring with the end rings of other limbs that have the same centre and diameter
// (tolerances.h), and with the limbs the limb numbers in `limbs` and in the segments. Not those that would
// turn back in it, nor those that lie about the axis of a third, thicker limb: twigs that begin in one place.
// Limbs that are already one are not joined a second time, so that there is no loop. O(n log n).
void join(Limbs& limbs, LimbSegments& segments);

}  // namespace copse
