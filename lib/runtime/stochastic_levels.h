// Levels of detail for what is a few pixels high: some triangles of a tree stand for all, each enlarged so
// that together they have the same area.
//
// Source: Cook, Halstead, Planck, Ryu, "Stochastic simplification of aggregate detail" (SIGGRAPH 2007). There
// elements are drawn in an order at random; here triangles are drawn by area, in equal steps through the
// order of the file, so that each stands for the same area and trunk and leaves keep their shares. Materials
// and texture coordinates stay, so cards stay cut out and colours stay as they are on average.
#pragma once

#include "lib/runtime/tree_geometry.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// Appends the triangles of a level to the vertices and indices of `geometry`; answers its ranges, in the
// order of `ranges` and with their parts and materials, without those that have no area. Together they have
// `wanted` triangles, at least one each, or `ranges` as they are where those have no more. No triangle leaves
// the box of the vertices of `ranges`: what would is enlarged less. Indices and area are the only things that
// count: the same geometry gives the same level. O(triangles + wanted).
std::vector<DrawRange> add_stochastic_level(TreeGeometry& geometry, std::span<const DrawRange> ranges,
                                            std::uint32_t wanted);

// Triangles enough for a tree that is so many pixels high, one a pixel that its box can cover.
std::uint32_t triangles_of_pixels(double pixels);

}  // namespace copse
