// ring_walk: from a graph of rings to a hierarchy of radii, from the root outward.
#pragma once

#include "lib/analysis/rings/hierarchy.h"
#include "lib/analysis/rings/ring_graph.h"

namespace copse {

// The root is the lowest of the thickest ends. Where limbs meet (a site):
// - a ring that lies on two rings with a band between them is the hole that a limb grows out of, from
//   whichever side the walk comes; so is one that lies by more than half on rings that are nearer the root:
//   the seat of a limb on its parent and no radius of its own; what follows it hangs on the radius that it
//   lies on;
// - where three or more limbs meet round vertices that no ring holds, these get a radius between them
//   (RadiusSource::surface), where the limbs' axes meet;
// - where the last ring of a limb runs out into what is no tube, a radius lies where that ends
//   (RadiusSource::surface);
// - the thickest and straightest limb carries on the branch.
// Diameters are 2/k sum |v - c| over the whole ring, also where some of its vertices belong to another
// radius. A vertex that closes the end of a limb is no radius; one that a limb tapers to is
// (RadiusSource::point). A ring that several ways lead to (a torus) hangs on the first of them; the band that
// is cut stays unexplained. Triangles of a site go with the segment whose axis is nearest, in its own radii.
// O(n log n).
Hierarchy walk_rings(const Surface& surface, const Bands& bands, const RingGraph& graph);

}  // namespace copse
