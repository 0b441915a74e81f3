// leaf_surfaces: leaves that are surfaces of many triangles (the solid lumps of a stylised crown) lose edges
// before they lose triangles.
//
// Leaf collapse takes leaves triangle by triangle, and a lump that a few dozen triangles close is torn to
// shreds by it. Such lumps are simplified by edge collapses (edge_collapse.h) for as long as they
// keep their area; what is left of them goes on as leaves.
#pragma once

#include "lib/analysis/lod/leaf_pieces.h"
#include "lib/formats/levels/spectrum.h"

#include <optional>

namespace copse {

struct SurfaceCollapse {
  Spectrum spectrum;  // method collapse; all leaves, from full detail on
  LeafPieces left;    // what its last step draws, to be collapsed further; a lump triangle by triangle
  std::uint32_t lumps = 0, triangles = 0;  // at full detail
  double share = 0;                        // of the leaves' area that is theirs
};

// Triangles of one leaf that share places (not only vertices: flat shading splits those) are one surface. A
// surface is a lump when it has no alpha, k_lump_triangles or more and at most k_lump_border of its edges on
// a border. Nothing when lumps are less than half of the leaves' area. What is no lump stays as it is.
//
// Which edge goes is half-edge collapse's choice; the vertex that stays is put where the planes of all faces
// that it stands for are nearest (Garland and Heckbert 1997), and the lump is scaled about its centre until
// it has its area again, as far as the crown's convex hull allows (1 % of its width beyond). By Cauchy's
// theorem a convex lump then covers what it covered, on the mean of all sides. Ends where the areas can no
// longer be held. A triangle keeps its own texture coordinates. Errors are 0: for hausdorff_errors.h to
// measure. Deterministic; one thread. O(n log n).
std::optional<SurfaceCollapse> collapse_surfaces(const LeafPieces& pieces);

inline constexpr std::size_t k_lump_triangles = 12;
inline constexpr double k_lump_border = 0.4;

// One spectrum after the other: `then` begins with what the last step of `first` draws. All errors are 0.
Spectrum joined(const Spectrum& first, const Spectrum& then);

}  // namespace copse
