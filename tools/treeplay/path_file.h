// Camera paths as JSON: {"schema":"copse.path/1","keys":[{"time":0,"eye":[x,y,z],"target":[x,y,z]}, ...]}.
#pragma once

#include "lib/formats/result.h"
#include "lib/runtime/camera_path.h"

#include <filesystem>

namespace copse::treeplay {

// "fov" (degrees) and "up" may stand in a key or at the top for all keys; `fov` (radians) is used where
// neither is given. Refuses unknown keys, so that a misspelt one is not passed over.
Result<CameraPath> read_path(const std::filesystem::path& file, double fov);

}  // namespace copse::treeplay
