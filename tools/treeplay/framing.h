// Where the camera stands when nobody says.
#pragma once

#include "lib/runtime/camera.h"
#include "tools/treeplay/scene.h"

namespace copse::treeplay {

// Sees the whole model, filling the picture but for a margin, from slightly above and from the side of +Z.
Camera framing(const Scene& scene, double aspect);

// The same from another side: `back` points from the model to the camera.
Camera framing(const Scene& scene, double aspect, const Double3& back, double fov);

}  // namespace copse::treeplay
