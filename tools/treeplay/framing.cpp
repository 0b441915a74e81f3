#include "tools/treeplay/framing.h"

#include <numbers>

namespace copse::treeplay {

Camera framing(const Scene& scene, double aspect) {
  // A forest is looked at from above its crowns, a tree from where people stand.
  return framing(scene, aspect, {0.42, scene.eco ? 0.45 : 0.085, 1}, 32 * std::numbers::pi / 180);
}

Camera framing(const Scene& scene, double aspect, const Double3& back, double fov) {
  const double margin = scene.eco ? 0.02 : 0.12;
  if (const auto camera = fit(scene.outline(), scene.geometry.origin, back, fov, aspect, margin))
    return *camera;
  Camera camera;
  camera.target = scene.geometry.origin;
  camera.eye = camera.target + normalized(back) * 3.0;
  camera.fov = fov;
  return camera;
}

}  // namespace copse::treeplay
