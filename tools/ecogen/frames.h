// What no frame of a camera path can show is left out.
#pragma once

#include "lib/analysis/ecosystem/value_map.h"
#include "lib/formats/ecosystem.h"
#include "lib/runtime/camera_path.h"

#include <cstdint>
#include <vector>

namespace copse::ecogen {

// Drops instances that stand in parts of the ground (64 x 64) whose trees lie outside every frame, or farther
// than `range` metres from every one (0: any distance). Conservative: frames are taken as wide as 2.4 : 1,
// 1000 of them along the path, and boxes grow by the longest step between two. Answers how many went.
std::uint64_t drop_unseen(std::vector<Instance>& instances, const std::vector<TreeType>& types,
                          const PlantedArea& area, const CameraPath& path, double range);

}  // namespace copse::ecogen
