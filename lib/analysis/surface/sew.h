// sew: which pieces of a surface that was cut up by its exporter belong together.
#pragma once

#include "lib/formats/mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// `triangles`: corners as welded representatives, into `positions`; `piece`: the piece of each, numbered from
// 0. Returns the surface of each piece: the lowest piece that it is sewn to.
// - Pieces whose boundary edges coincide are sewn. (A boundary edge belongs to one triangle of its piece.)
//   But two that are folded back on one another along most of the edges that they share, wound against one
//   another, are two surfaces: tubes that begin in one place and lead the same way, as siblings do that grow
//   out of their parent. Where a file winds triangles anyhow, which its seams tell, each piece is taken to be
//   wound outward (turned_triangles), and the two must share edges all the way round: single faces are
//   pieces, too, and what is outward of them nobody knows.
// - A piece whose closed boundary loop coincides edge by edge with inner edges of another is sewn to it: a
//   branch that starts on a ring of its parent.
// - Pieces that share single points, or edges inside both, only touch.
// O(n log n) in the edges at which pieces meet, linear in the rest.
std::vector<std::uint32_t> sew(std::span<const Double3> positions, std::span<const Triangle> triangles,
                               std::span<const std::uint32_t> piece);

}  // namespace copse
