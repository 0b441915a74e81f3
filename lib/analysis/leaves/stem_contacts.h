// stem_contacts: which stems of a mesh hang on others, by touch.
//
// A twig of its own begins inside its bough, on its surface or a little off it; the stalk of a leaf begins in
// the open or on another leaf. Where names tell nothing this tells wood.
#pragma once

#include "lib/analysis/leaves/piece_scan.h"
#include "lib/formats/mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// For each of `stems` whether it touches one of `standing`, or one that does, and so on; of the standing ones
// themselves it is true. Two touch where a triangle of one crosses one of the other, or a corner of one is as
// near to the other as the thicker of the two is thick in the mean, at most a tenth of its size. Both:
// ascending places in scan.placed(), `standing` among `stems`. O(n log n) in their triangles, and what is
// near.
std::vector<std::uint8_t> stem_contacts(const Mesh& mesh, const PieceScan& scan,
                                        std::span<const std::uint32_t> stems,
                                        std::span<const std::uint32_t> standing);

}  // namespace copse
