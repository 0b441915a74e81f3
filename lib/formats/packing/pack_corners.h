// What the corners of a packed trunk carry (pack_trunk.h): normals against the surface, turned from it as
// those of the neighbours are; texture coordinates as one of the neighbours', or one of the last.
#pragma once

#include "lib/formats/packing/pack_trunk.h"
#include "lib/formats/packing/range_coder.h"
#include "lib/formats/tree/tree_header.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace copse {

// The base that brings the normals of this trunk nearest; faces if they are flat.
TrunkNormals nearest_normals(const PackedTrunk& trunk, std::uint32_t roots);

// Codes them, or fills them by what is coded; all else of the trunk is there. `lines`: its segments. What is
// wrong with what is decoded, empty when nothing is.
std::string code_corners(RangeCoder& coder, PackedTrunk& trunk,
                         std::span<const std::array<std::uint32_t, 2>> lines, const Head& head);

}  // namespace copse
