// The interactive player: a window, an orbiting camera, keys, and an overlay with counts and times.
#pragma once

#include "lib/runtime/camera_path.h"
#include "tools/treeplay/options.h"
#include "tools/treeplay/scene.h"
#include "tools/treeplay/statistics.h"

namespace copse::treeplay {

// Until the window is closed, or for options.exit_after frames.
Result<void> run_viewer(const Scene& scene, const CameraPath& path, const Options& options, const Plan& plan,
                        LevelChoice& choice, Statistics& statistics, Context& context);

}  // namespace copse::treeplay
