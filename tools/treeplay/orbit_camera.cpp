#include "tools/treeplay/orbit_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace copse::treeplay {

void OrbitCamera::look(const Camera& camera) {
  const Double3 arm = camera.eye - camera.target;
  target_ = camera.target;
  distance_ = std::max(length(arm), 1e-12);
  azimuth_ = std::atan2(arm.x, arm.z);
  elevation_ = 0;
  fov_ = camera.fov;
  turn(0, std::asin(std::clamp(arm.y / distance_, -1.0, 1.0)));
}

void OrbitCamera::turn(double azimuth, double elevation) {
  constexpr double k_steepest = std::numbers::pi / 2 - 0.01;
  azimuth_ = std::remainder(azimuth_ + azimuth, 2 * std::numbers::pi);
  elevation_ = std::clamp(elevation_ + elevation, -k_steepest, k_steepest);
}

void OrbitCamera::approach(double steps) {
  distance_ = std::clamp(distance_ * std::pow(0.9, steps), 1e-12, 1e12);
}

void OrbitCamera::slide(double right, double up) {
  const CameraFrame f = frame_of(camera());
  target_ += (f.right * right + f.up * up) * (2 * distance_ * std::tan(fov_ / 2));
}

Camera OrbitCamera::camera() const {
  Camera c;
  c.target = target_;
  c.eye = target_ + Double3{std::sin(azimuth_) * std::cos(elevation_), std::sin(elevation_),
                            std::cos(azimuth_) * std::cos(elevation_)} *
                        distance_;
  c.fov = fov_;
  return c;
}

}  // namespace copse::treeplay
