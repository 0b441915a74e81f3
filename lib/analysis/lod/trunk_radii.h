// The trunk's spectrum by radii (digest 000, section 5.7 and table 5.1): rings along the axis go first, then
// sides, then the tube becomes a flat ribbon, then one triangle, then nothing, limb by limb, so that the
// trunk keeps its structure and there is no floor at any ratio.
#pragma once

#include "lib/analysis/lod/limb_ladder.h"
#include "lib/formats/levels/spectrum.h"
#include "lib/formats/tree/tree.h"

namespace copse {

struct TrunkRadiiOptions {
  // What a limb that vanishes costs, in what a limb that shrinks to its axis costs.
  double vanish = 6;
  // The same of a limb that bears leaves: they would hang in the air, so as long as it is there the leaves
  // may stay as they are.
  double vanish_with_leaves = 30;
  // Which rings of a limb go first. By diameter, limbs go thinnest first too (table 5.1); otherwise all limbs
  // share one order by cost a triangle.
  RemovalOrder order = RemovalOrder::silhouette;
};

// Every limb has a ladder of tubes from its own triangles to nothing; each rung costs the area of silhouette
// by which it errs: the deviation of the rings that it leaves out times the length, the roughness of its
// polygon, or all of its width. The rungs of all limbs together are taken in the order of cost a triangle
// saved (the convex ladder of each, so the greedy order is optimal), a limb only after the limbs that grow
// from it. errors[n]: a bound on the distance from full detail's rings, metres; a limb that is gone errs by
// its length. Tubes that are made have the mean width of what they replace: a k-gon is scaled to the
// perimeter of its ring. Of a tree without a hierarchy: the trunk in full detail and no steps. O(n log n) in
// the radii and triangles.
Spectrum trunk_by_radii(const Tree& tree, const TrunkRadiiOptions& options = {});

}  // namespace copse
