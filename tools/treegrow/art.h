// Painted textures: bark that tiles, and leaves cut out by alpha.
#pragma once

#include "lib/formats/import/image.h"
#include "tools/treegrow/canvas.h"
#include "tools/treegrow/species.h"
#include "tools/treegrow/treegrow.h"

#include <cstdint>
#include <vector>

namespace copse::grow {

inline constexpr int k_texture_size = 512;

// Tiles in both directions.
Canvas paint_bark(BarkArt art, const Float3& colour, int size, std::uint64_t seed);

// Four drawings, two by two, each with its stalk at the bottom middle of its quarter; `triangular`: inside
// the triangle with one corner there and two at the top. Grass is one drawing.
Canvas paint_leaves(const Foliage& leaves, bool triangular, int size, std::uint64_t seed);

// The pictures of a mesh's materials, in their order. Empty where a mesh has no materials or texture
// coordinates; a material beyond the end (solid lumps of leaves) has none.
std::vector<Image> paint(const Order& order, std::size_t materials, int size = k_texture_size);

}  // namespace copse::grow
