// cage_axes: the polylines that a cage was laid round.
#pragma once

#include "lib/analysis/rings/hierarchy.h"
#include "lib/analysis/surface/reverse_subdivision.h"

namespace copse {

// The hierarchy of the surface whose cage this is. A tool that puts a skin on a graph of lines lays a ring
// of four round each corner of a line and more between them, where centre and radius run straight from
// corner to corner; nothing round a fork, where it hulls the rings next to it and moves corners that are
// close. All of that is exact in the cage. So rings between corners are left out, and a fork is put where the
// tool's rules have it (hull_frames); where they do not come out, where the limbs' axes meet, as rings that
// were not moved (opposite corners lie evenly about one middle) point to it: a ring stands in the plane that
// halves the bend, so two of them tell where the axis goes on beyond them. A radius is that of the subdivided
// ring on a straight limb: 2/k sum |v - c| after smoothing along the ring alone.
//
// Vertex and triangle ids are the surface's, `triangles` of them; radii[0] is the one root. No radii where
// the cage has no rings, or less than half of its faces lie between rings. O(n log n).
Hierarchy cage_axes(const Cage& cage);

}  // namespace copse
