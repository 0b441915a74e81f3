// strict_hierarchy: the hierarchy of a model that obeys the thesis' rules, exactly as its listings read it.
//
// Digest 000, sections 1.2 and 1.3: centre and mean diameter of each radius, its parent; and section 1.5, the
// segment that each triangle belongs to.
#pragma once

#include "lib/analysis/rings/hierarchy.h"
#include "lib/analysis/surface/trunk_mesh.h"
#include "lib/analysis/trunk/strict_model.h"

#include <cstdint>
#include <span>

namespace copse {

struct StrictTrunk {
  TrunkMesh mesh;
  Hierarchy hierarchy;
};

// `model` is what read_strict_model made of the other arguments, and has no breaches. Radii: parents first, a
// branch's main line (its thickest child) before its side branches. A triangle that lies in one ring alone
// (a lid) counts to the segment that ends in it, at a root to the thickest that begins there. O(n log n).
StrictTrunk strict_hierarchy(const StrictModel& model, const Mesh& mesh,
                             std::span<const std::uint32_t> welded, std::span<const std::uint32_t> leaf_of);

}  // namespace copse
