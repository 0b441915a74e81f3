// kdop: discrete oriented polytopes: how far points reach along k / 2 fixed directions and against them.
//
// Source: J. Klosowski, M. Held, J. Mitchell, H. Sowizral, K. Zikan, "Efficient collision detection using
// bounding volume hierarchies of k-DOPs" (1998); other counts: directions of a Fibonacci spiral.
#pragma once

#include "lib/formats/volumes/volume.h"

#include <span>
#include <vector>

namespace copse {

// k / 2 directions, none opposite to another. 6: the axes; 8: the diagonals of the cube; 12: of its faces;
// 14, 18, 26: the axes with one or both of these; their components are -1, 0 or 1. Any other even k >= 2:
// unit vectors spread evenly over half of the sphere (fewer than 6 do not bound a volume). The same every
// time.
std::vector<Double3> kdop_normals(int k);

// Round at least one point. O(n k).
Kdop<double> fit_kdop(std::span<const Double3> points, std::vector<Double3> normals);

}  // namespace copse
