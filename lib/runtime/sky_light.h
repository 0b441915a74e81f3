// How much of the sky each place in and round a tree sees, on a coarse grid: the soft light that makes a
// crown look deep and a trunk look planted.
//
// The tree is taken as a cloud: each cell of the grid holds the projected area of the triangles in it, and a
// ray of length s through it keeps exp(-s * density) of its light (Beer and Lambert). For every direction of
// the upper half of a uniform sky the light is swept through the grid slab by slab; what arrives is kept as
// the first two bands of spherical harmonics.
#pragma once

#include "lib/runtime/matrix.h"
#include "lib/runtime/tree_geometry.h"

#include <cstddef>
#include <span>
#include <vector>

namespace copse {

struct SkyLight {
  std::array<std::size_t, 3> size{1, 1, 1};  // cells along x, y, z
  Float3 corner;                             // the grid's lower corner
  float cell = 1;                            // the side of a cell
  // x fastest, then y, then z. The light that a white surface with unit normal n sends back, as a share of
  // what it would send back facing an open sky: max(0, w + x n.x + y n.y + z n.z).
  std::vector<Float4> cells{{0, 0.5f, 0, 0.5f}};
  // From the grid's middle (0) to its border (1): from where on the sky opens towards what is outside.
  Float3 opens{0.7f, 0.7f, 0.7f};
};

// `opacity` has one entry a range of the geometry: its material's alpha times its alpha coverage. The grid
// covers the bounds and half their size on every side, `resolution` cells along its longest side.
// O(triangles + resolution^3 * directions); deterministic.
SkyLight make_sky_light(const TreeGeometry& geometry, std::span<const float> opacity,
                        std::size_t resolution = 48);

// A point that takes light away from what is round it.
struct SkyOccluder {
  Float3 position;
  float area =
      0;  // projected, the mean over all directions, m^2: half of a card's, a quarter of a closed surface's
};

// The same for what is wide and low, a forest: the grid covers the bounds, two cells beside them and one
// above, so its cost goes with their area; cells are cubes, `resolution` (at least 8) along the longest side.
// The open sky where nothing takes light. O(occluders + cells * directions); deterministic.
SkyLight make_sky_light(std::span<const SkyOccluder> occluders, const FloatBox& bounds,
                        std::size_t resolution);

}  // namespace copse
