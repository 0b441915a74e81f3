// united_tubes: the hierarchy of a surface that a boolean union has made of tubes.
//
// A union keeps each tube's rings where they are whole and cuts the faces beside the others'. So the surface
// is taken apart again along the sharp valleys where tubes meet (each is a closed line), each piece is read
// as one tube, and what the cuts took is completed.
#pragma once

#include "lib/analysis/rings/hierarchy.h"
#include "lib/analysis/surface/bands.h"
#include "lib/analysis/surface/surface.h"

namespace copse {

// `bands`: those that were read of the surface (fork_rings.h); those that reach across a valley, or touch
// one, are left out. Whole rings are RadiusSource::ring or ::point. Rings with corners missing are circles
// through those that are left, and a limb begins where its axis, with the taper of its last whole band, comes
// nearest to its parent's: both RadiusSource::surface. All triangles of a cut band go with a segment of the
// tube that they lie on. No radii where there is no valley all round, or where a piece is no tube. The
// hierarchy has one root. O(n log n).
Hierarchy read_united_tubes(const Surface& surface, const Bands& bands);

}  // namespace copse
