// Fitted volumes as sections of a tree's file.
#pragma once

#include "lib/formats/tree_file/tree_volumes.h"
#include "tools/bvfit/fits.h"

#include <span>
#include <vector>

namespace copse::bvfit {

// The file of the input with these volumes and nodes instead of those that it may have. Refused when the
// input is no tree.
Result<std::vector<std::uint8_t>> tree_with_volumes(const Input& input, std::span<const SetFit> sets,
                                                    std::span<const VolumeNode> nodes);

}  // namespace copse::bvfit
