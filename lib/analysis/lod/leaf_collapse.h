// leaf_collapse: two leaves become one bigger, again and again, from all leaves to one.
//
// After Remolar, Chover, Belmonte, Ribelles, Rebollo, "Geometric simplification of foliage" (Eurographics
// 2002): leaves are collapsed instead of edges, because a crown has no surface. Beyond it: pictures from all
// round decide. What no one sees goes first and takes the area of what goes with it to where no one sees it;
// what is left of the picture stays as it was. Where leaves that are seen must go, the one is taken for two
// that covers most of what they covered and least of what was open.
#pragma once

#include "lib/analysis/measure/alpha_raster.h"
#include "lib/formats/levels/spectrum.h"
#include "lib/formats/tree/tree.h"

#include <cstdint>

namespace copse {

// fast: after leaf_occlusion.h closed forms, no pictures (leaf_agglomeration.h, which none of the other
// options reaches); balanced: the same while there are many leaves, then pictures of three pixels a leaf
// decide, at some points of each candidate; exact: pictures of five pixels, drawn again after half as many
// changes, more candidates, and all of their pixels.
enum class CollapseQuality : std::uint8_t { fast, balanced, exact };

struct LeafCollapseOptions {
  CollapseQuality quality = CollapseQuality::balanced;
  int cells = 0;         // of the crown's grid along its longest side; 0: as many as the leaves call for
  double largest = 0.6;  // of a leaf's area, as a share of the crown's cross-section: what fits inside
  double emptiness = 2;  // how much reaching into empty space counts beside moving
  int window = 8;        // neighbours looked at on each side
  double other = 0.04;   // what a pixel counts that shows another leaf, beside one that is lost or gained
  bool errors = true;    // are measured; not: for who measures them later, of the steps in another order
};

// Which of the leaves lost edges before they were merged (leaf_surfaces.h), and what went before.
struct CollapsedLumps {
  std::uint32_t lumps = 0, triangles = 0;  // at full detail
  std::uint32_t left = 0;                  // triangles when edges were done: of all leaves
  double share = 0;                        // of the leaves' area
  std::uint32_t twins = 0;                 // triangles that lie on others and went first (leaf_twins.h)
};

// The spectrum of the tree's leaves; without elements when it has none. An opaque leaf becomes a triangle,
// triangle by triangle; one whose texture has alpha a card of two triangles with the texture of one of the
// leaves that it stands for (or a triangle, where the leaves are triangles). Where most of the area is of
// surfaces of many triangles these lose edges first (leaf_surfaces.h). Of triangles that lie on one another
// all but one go before anything else, and count in no area from there on (leaf_twins.h). `looks`: the masks
// of the materials' textures; without them leaves with alpha are taken as opaque. What stands for leaves of
// several twigs hangs on the lowest radius that bears them all. While many leaves are hidden they only leave,
// nothing grows, and the sum of areas falls with them, coverage does not (leaf_occlusion.h); below 0.19 of
// the triangles the areas add up to what they were, as long as that fits
// (`largest`). A step's error, metres: the distance of
// what is drawn from full detail (hausdorff_errors.h). Steps come in the
// order of what they change in the picture, as far as can be. `lumps`: told what lost edges. Deterministic.
// O(n log n): each round draws what is left from 6 or 12 sides and takes away an eighth to a fourth of it.
Spectrum collapse_spectrum(const Tree& tree, const Looks& looks = {}, const LeafCollapseOptions& options = {},
                           CollapsedLumps* lumps = nullptr);

}  // namespace copse
