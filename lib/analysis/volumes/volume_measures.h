// volume_measures: interior volume, surface and mean width of every type of bounding volume, in closed form.
//
// A random line that hits a convex body hits one inside it with probability proportional to its surface
// (Cauchy); a random plane with probability proportional to its mean width (Crofton).
// Source: digest 002, section 4.8; anchors of section 6; Steiner's formulas for sums of segments, discs and
// balls; for ellipsoids Carlson's R_G (DLMF 19.23.6, 19.33.1); for k-DOPs the polyhedron's faces and edges.
#pragma once

#include "lib/formats/volumes/volume.h"

namespace copse {

struct VolumeMeasures {
  double volume = 0, surface = 0, mean_width = 0;
  friend bool operator==(const VolumeMeasures&, const VolumeMeasures&) = default;
};

// A body without thickness has the limits: a rectangle's surface is twice its area. Of axes only the
// directions are used. A k-DOP that is empty has zeros, one that is not bounded infinities; O(k^2) for k
// planes.
VolumeMeasures measures_of(const Box<double>& v);
VolumeMeasures measures_of(const BoundingSphere<double>& v);
VolumeMeasures measures_of(const OrientedBox<double>& v);
VolumeMeasures measures_of(const Capsule<double>& v);
VolumeMeasures measures_of(const Cylinder<double>& v);
VolumeMeasures measures_of(const Lozenge<double>& v);
VolumeMeasures measures_of(const Ellipsoid<double>& v);
VolumeMeasures measures_of(const Kdop<double>& v);
VolumeMeasures measures_of(const Volume<double>& v);

}  // namespace copse
