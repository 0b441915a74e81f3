// What no frame of a camera path can show is left out.
#pragma once

#include "lib/analysis/ecosystem/value_map.h"
#include "lib/formats/ecosystem/ecosystem.h"
#include "lib/runtime/camera_path.h"

#include <cstdint>
#include <vector>

namespace copse::ecogen {

struct Seen {
  std::uint64_t dropped = 0;  // instances
  // Of every type: metres from the eye that a frame shows any of it at most; 0: none does.
  std::vector<double> farthest;
};

// Drops instances that stand in parts of the ground (64 x 64) where no frame shows their type, because it
// lies outside every one or beyond the type's view range. Conservative: frames are taken `aspect` times as
// wide as they are high, 1000 of them along the path, and boxes grow by what the camera may move, turn and
// widen between two, and sideways by the shadow that they cast on level ground while the sun stands at least
// `lowest_sun` degrees above the horizon, wherever it stands (above 0; 90: by none).
Seen drop_unseen(std::vector<Instance>& instances, const std::vector<TreeType>& types,
                 const PlantedArea& area, const CameraPath& path, double aspect, double lowest_sun);

}  // namespace copse::ecogen
