// leaf_shape: the one leaf that stands for many: where it is, how it lies, and how it is cut.
//
// It has the area of the leaves that it stands for, lies where they lie (its centre is theirs), is as much
// longer than wide as they are spread, faces as they face or lies in the plane in which they are spread, and
// stays where foliage is: of several candidates the one is taken that reaches least into empty space and
// turns least.
#pragma once

#include "lib/analysis/lod/crown_field.h"
#include "lib/analysis/lod/patch.h"

#include <array>

namespace copse {

struct LeafShape {
  std::array<Double3, 4> corners;  // a triangle uses three of them; a card is a parallelogram 0 1 2 3
  Double3 normal;
  double displacement =
      0;  // metres: how far its area is from that of the leaves, root mean square, as estimated
};

struct ShapeOptions {
  bool card = false;      // four corners; otherwise a triangle
  bool textured = false;  // it has a picture on it: it is turned as the leaves' pictures are
  double largest = 0;     // its area at most; 0: as large as the leaves together
  bool search = true;     // look further when no candidate is good
  double slimmest = 3;    // length over width, at most
  // What counts how much, all as shares of its area: covering more or less open ground than the leaves did,
  // reaching into emptiness, being elsewhere, being turned.
  double openness = 4, emptiness = 1, moving = 1, turning = 0.3;
};

// The field may be null: then nothing is known of emptiness. Positions are relative to `offset` (a patch's
// moments are taken near the origin, the field is in the tree's frame). Constant cost: some dozens of
// look-ups.
LeafShape leaf_shape(const Patch& patch, const CrownField* field, const Double3& offset,
                     const ShapeOptions& options);

}  // namespace copse
