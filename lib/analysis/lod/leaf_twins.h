// leaf_twins: leaves that are modelled from both sides.
//
// A triangle whose three places are those of another, whichever way it faces, shows nothing: where faces are
// drawn from both sides it is never seen. If both counted, a crown of such leaves would have twice the area
// to keep, and swell. So one of them goes before anything else does, and only the other collapses.
#pragma once

#include "lib/analysis/lod/leaf_pieces.h"
#include "lib/formats/levels/spectrum.h"

#include <optional>
#include <vector>

namespace copse {

struct LeafTwins {
  LeafPieces left;  // without them
  std::vector<std::uint32_t>
      gone;  // triangles of the pieces' part: of equal ones all but the first; ascending
};

// Nothing when there are none. O(n log n).
std::optional<LeafTwins> part_twins(const LeafPieces& pieces);

// The spectrum of all of `pieces`: the twins go, in k_twin_steps steps at most, then `then`, which is that of
// what is left, takes its own. All errors are 0: for hausdorff_errors.h to measure.
Spectrum twins_first(const LeafPieces& pieces, const LeafTwins& twins, const Spectrum& then);

inline constexpr std::size_t k_twin_steps = 256;

}  // namespace copse
