// recover: the whole trunk, from triangles to one or more hierarchies of radii.
#pragma once

#include "lib/analysis/rings/hierarchy.h"
#include "lib/analysis/surface/trunk_mesh.h"

#include <cstdint>
#include <vector>

namespace copse {

enum class Skeleton : std::uint8_t {
  automatic,  // rings where a surface shows them, a surface skeleton where it does not
  rings,      // rings only; surfaces without stay unexplained
  surface,    // a surface skeleton everywhere
};

struct RecoverOptions {
  Skeleton skeleton = Skeleton::automatic;
  // Where trees begin: each at the end of a limb that is nearest to a point, metres, whatever else speaks for
  // another; of two points at one limb the first counts (a note says so). Empty: recover_hierarchy() decides.
  std::vector<Double3> roots = {};
};

// Reads every surface as a limb (ring_reader.h, else welded.h), joins limbs that are laid end to end
// (join.h), finds where each begins (root.h) and what it grows from (attach.h). Parents come before children,
// the main line of a branch before its side branches. segment_of names a segment for all triangles of bands
// and lids; a lid counts to the segment that ends in its ring. Never fails; near-linear in time; memory
// linear; no recursion.
Hierarchy recover_hierarchy(const TrunkMesh& mesh, const RecoverOptions& options = {});

}  // namespace copse
