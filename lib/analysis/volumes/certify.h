// certify: whether every point lies inside a volume, exactly, by the inequality of
// lib/formats/volumes/volume.h.
//
// The numbers are taken as they are, so what is proven holds for the volume as written. Doubles with a
// running bound of their rounding error decide all points but those within a few roundings of the surface;
// twice the digits, which lose none of a few products of float32 numbers, most of those (all points of a
// tilted floor lie on the faces of its box); exact rational arithmetic (CGAL) decides what is left. Nothing
// here is shared with the fitters.
//
// Source: running error analysis: N. J. Higham, "Accuracy and Stability of Numerical Algorithms" (2002), 3.3.
#pragma once

#include "lib/formats/volumes/volume.h"

#include <cstddef>
#include <span>

namespace copse {

struct Certificate {
  std::size_t points = 0;
  std::size_t outside = 0;
  std::size_t worst = 0;  // of those outside, the one that is farthest out (the first of several)
  double excess = 0;      // how far out it is, in the unit of the points; 0 when none is
  std::size_t near = 0;   // points that doubles could not decide
  std::size_t exact = 0;  // of those, points that only rational arithmetic could
  bool holds() const { return outside == 0; }
};

// Finite points. A volume that is none (a number that is not finite, a negative radius or extent, axes that
// are not unit and at right angles, a lozenge whose edges are not, a cylinder without a length, a k-DOP whose
// arrays differ in size or whose normals do not span space) contains nothing. O(points); some 30 ns a point.
Certificate certify(const Volume<double>& volume, std::span<const Double3> points);
Certificate certify(const Volume<float>& volume, std::span<const Double3> points);

// The same numbers in double: exact.
Volume<double> to_double(const Volume<float>& volume);

}  // namespace copse
