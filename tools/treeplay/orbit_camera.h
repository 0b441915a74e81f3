// A camera that is led by a mouse: it turns round a point, comes nearer, and slides along the picture.
#pragma once

#include "lib/runtime/camera.h"

namespace copse::treeplay {

class OrbitCamera {
 public:
  explicit OrbitCamera(const Camera& camera) { look(camera); }
  void look(const Camera& camera);
  // Angles in radians; the elevation stops just short of straight up and down.
  void turn(double azimuth, double elevation);
  void approach(double steps);  // each step a tenth nearer; negative: farther
  // Slides by a part of the picture's height.
  void slide(double right, double up);
  Camera camera() const;

 private:
  Double3 target_;
  double azimuth_ = 0, elevation_ = 0, distance_ = 1, fov_ = 0.6;
};

}  // namespace copse::treeplay
