// lozenge: the quick way to fit a lozenge (a rectangle swept by a ball).
//
// Source: digest 002, section 4.5 (Eberly 1999), with the square root of the errata.
#pragma once

#include "lib/analysis/swept/swept_shape.h"
#include "lib/formats/volumes/volume.h"

#include <span>

namespace copse {

double interior_volume(const Lozenge<double>& l);

// The distance of p from the rectangle, by the inequality of lib/formats/volumes/volume.h.
double distance_from_rectangle(const Lozenge<double>& l, const Double3& p);

// The lozenge with its radius as large as these points need, by that inequality in double arithmetic; O(n).
Lozenge<double> enclosing(Lozenge<double> l, std::span<const Double3> points);

// In a given frame: the radius is half the extent across, the sides are those of the two capsules seen from
// the sides, and corners move out to the points that they leave out. O(n).
Lozenge<double> lozenge_in_frame(std::span<const Double3> points, const Axes& frame);

// In the principal frame. O(n): some 40 ns a point.
Lozenge<double> gaussian_lozenge(std::span<const Double3> points);

Lozenge<double> placed(const SweptRectangle& s, const Axes& frame);

}  // namespace copse
