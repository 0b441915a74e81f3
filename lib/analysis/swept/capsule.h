// capsule: the quick ways to fit a capsule.
//
// Source: digest 002, section 4.4 (Eberly 1999): least squares, and the smallest projected circle; the ends
// are in both where the half spheres touch the points (xi0 and xi1, with the sign of the errata).
#pragma once

#include "lib/analysis/hull/deadline.h"
#include "lib/analysis/swept/swept_shape.h"
#include "lib/formats/volumes/volume.h"

#include <span>

namespace copse {

double interior_volume(const Capsule<double>& c);

// The distance of p from the segment, by the inequality of lib/formats/volumes/volume.h.
double distance_from_segment(const Capsule<double>& c, const Double3& p);

// The capsule with its radius as large as these points need, by that inequality in double arithmetic; O(n).
Capsule<double> enclosing(Capsule<double> c, std::span<const Double3> points);

// The smallest radius about a line, and the ends nearest to one another with it. A line that some point's
// half spheres overlap gives a ball: a = b. O(n).
Capsule<double> capsule_on_line(std::span<const Double3> points, const Double3& on_line,
                                const Double3& direction);

// Along the line of least squares. O(n): some 20 ns a point.
Capsule<double> least_squares_capsule(std::span<const Double3> points);

// Along the direction in which the smallest circle about the projected points is smallest: the axis of the
// thinnest cylinder around them (the least of the local minima from the principal axes and the directions
// between them). Pass the hull's vertices, |p| about 1: some 2 ms for a hundred.
// With a deadline, the best that is found by then.
Capsule<double> projected_circle_capsule(std::span<const Double3> points, const Deadline& deadline = {});

}  // namespace copse
