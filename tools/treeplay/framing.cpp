#include "tools/treeplay/framing.h"

#include <algorithm>
#include <numbers>
#include <vector>

namespace copse::treeplay {

Camera framing(const Scene& scene, double aspect) {
  return framing(scene, aspect, {0.42, 0.085, 1}, 32 * std::numbers::pi / 180);
}

Camera framing(const Scene& scene, double aspect, const Double3& back, double fov) {
  std::vector<Float3> points(scene.geometry.vertices.size());
  std::transform(scene.geometry.vertices.begin(), scene.geometry.vertices.end(), points.begin(),
                 [](const DrawVertex& v) { return v.position; });
  if (const auto camera = fit(points, scene.geometry.origin, back, fov, aspect, 0.12)) return *camera;
  Camera camera;
  camera.target = scene.geometry.origin;
  camera.eye = camera.target + normalized(back) * 3.0;
  camera.fov = fov;
  return camera;
}

}  // namespace copse::treeplay
