// enclose: a fitted volume as float32 that is proven to contain every point as stored.
//
// What places and turns the volume is rounded to the nearest float32 (centres, axes) or to ends that keep the
// line (grid_axis.h); what sizes it is then taken anew from the points against those rounded numbers and
// rounded up, and grown by units in the last place until certify.h says that no point is outside. So nothing
// of the fitter's arithmetic is trusted.
//
// Inflation: a few units in the last place of the volume's size (of a cylinder's radius: of its own), or of
// the coordinates where it lies far from the origin. Two inequalities of volume.h cannot be met that closely
// by a set of no thickness: a cylinder across a tilted plane gets the height at which its axis still has a
// direction (4.5e-5 of its radius), and an ellipsoid's axis of length 0 becomes one of about
// two units while the others grow by at most 1.3.
#pragma once

#include "lib/formats/volumes/volume.h"

#include <optional>
#include <span>

namespace copse {

struct Enclosed {
  Volume<float> volume;
  bool certified = false;  // by certify.h, on `points`
};

// points: finite, at least one; `corners`: those of them that the others lie between (their hull's vertices),
// to take the sizes from; if they turn out not to be enough, or are left out, all points are used. None when
// float32 cannot hold such a volume (coordinates or sizes beyond 3.4e38). O(points), twice or so.
std::optional<Enclosed> enclose(const Volume<double>& fitted, std::span<const Double3> points,
                                std::span<const Double3> corners = {});

}  // namespace copse
