// leaf_collapse: two leaves become one bigger, again and again, from all leaves to one.
//
// After Remolar, Chover, Belmonte, Ribelles, Rebollo, "Geometric simplification of foliage" (Eurographics
// 2002): leaves are collapsed instead of edges, because a crown has no surface. Beyond it: which leaves are
// seen decides which are collapsed first (the inside of a dense crown goes long before its outline), a new
// leaf has the exact moments of all the leaves that it stands for, keeps their area, and must not reach out
// of the foliage; so area, coverage and outline hold together.
#pragma once

#include "lib/formats/spectrum.h"
#include "lib/formats/tree.h"

#include <cstdint>

namespace copse {

struct LeafCollapseOptions {
  int cells = 0;          // of the crown's grid along its longest side; 0: as many as the leaves call for
  double largest = 0.36;  // of a leaf's area, as a share of the crown's cross-section: what fits inside
  double turning = 1.5;   // how much turning a leaf counts beside moving it
  double least_seen = 0.0005;  // what no one sees counts as if this share of it were seen
  double emptiness = 2;        // how much reaching into empty space counts beside moving
  int window = 8;              // neighbours looked at on each side
};

// The spectrum of the tree's leaves; without elements when it has none. An opaque leaf becomes a triangle,
// triangle by triangle; one whose texture has alpha a card of two triangles with the texture of one of the
// leaves that it stands for (or a triangle, where the leaves are triangles). The group of a twig is collapsed
// to one leaf before that is merged with another group's; what stands for several groups hangs on the lowest
// radius that bears them all. A step's error: the largest displacement of a leaf so far, root mean square,
// metres. Steps come in the order of the visible area that they displace. Deterministic. O(n log n).
Spectrum collapse_spectrum(const Tree& tree, const LeafCollapseOptions& options = {});

}  // namespace copse
