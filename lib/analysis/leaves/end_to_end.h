// end_to_end: which pieces of a surface go on from one another, as tubes laid end to end do.
//
// A generator may cut a stem into tubes that share no vertex: each begins with the ring that the one before
// ended with, turned a little or of another number of sides. Cut off like that, the flared foot of a trunk is
// as wide as it is long, and by its shape alone no one can tell it from a blossom.
#pragma once

#include "lib/analysis/leaves/pieces.h"
#include "lib/formats/mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// For each piece the lowest piece of its chain, itself where it goes on from none. Two of `asked` go on from
// one another where borders of theirs, closed rings of three vertices or more, have the same centre and mean
// radius (surface/tolerances.h: k_join_tolerance, k_rounding) and lead away from there to opposite sides, and
// they are of one material (a crown that sits on the last ring of a trunk has another one). `asked`:
// ascending pieces; the others are on their own. Linear in the triangles of `asked`, but for sorting the
// border edges of each and the rings in one place.
std::vector<std::uint32_t> end_to_end(const Mesh& mesh, std::span<const std::uint32_t> welded,
                                      const Pieces& pieces, const PieceTriangles& triangles,
                                      std::span<const std::uint32_t> asked);

}  // namespace copse
