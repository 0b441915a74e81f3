// A tree's file as it goes into an ecosystem: without what no frame of the scene can show.
#pragma once

#include "lib/formats/ecosystem/ecosystem.h"
#include "lib/formats/result.h"
#include "tools/common/tool.h"
#include "tools/ecogen/build.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace copse::ecogen {

// What a scene asks of a type's tree.
struct TreeUse {
  bool own_trunk_material = false, own_leaf_material = false;  // some instance brings none of its own
  bool stands = false, moves = false;                          // some instance does
  double farthest = 0;  // metres from the eye, at scale 1, at which a frame shows it at most
};

// The file of `tree` without its provenance; without textures that only parts have whose instances bring
// their own materials; without levels of detail (and the picture behind them) and foliage cells when full
// detail reaches as far as it is shown; of bounding volumes only those to test with, and envelopes only of
// what moves. Texture files beside the tree are copied in; one that is not there stays a name, with a
// warning. Notes in `left_out` what went and the bytes that it had.
Result<std::vector<std::uint8_t>> pack_tree(const std::filesystem::path& tree, const TreeUse& use,
                                            std::vector<LeftOut>& left_out, Context& context);

}  // namespace copse::ecogen
