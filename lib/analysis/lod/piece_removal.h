// piece_removal: what is left of a mesh when its edges cannot be collapsed any further, piece by piece away.
//
// Collapses keep a tube of every branch that is one of its own: with many such branches they end far above
// what a small level may have.
#pragma once

#include "lib/formats/levels/spectrum.h"

#include <cstdint>

namespace copse {

// `spectrum` with a step more for each connected piece that is drawn after its last step: the one of the
// least area goes first, of equal ones that of the first triangle. The largest stays, and so does what would
// leave fewer than `min_triangles`. A piece that has gone errs by the diagonal of its box (an estimate: what
// bore it is near). Triangles whose corners share a position are connected. O(n log n).
Spectrum remove_pieces(const Spectrum& spectrum, std::uint64_t min_triangles = 0);

}  // namespace copse
