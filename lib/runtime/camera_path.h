// Paths that a camera follows: a position for every moment t in [0, 1]. Evaluating one allocates nothing.
#pragma once

#include "lib/formats/result.h"
#include "lib/runtime/camera.h"

#include <vector>

namespace copse {

struct PathKey {
  double time = 0;
  Camera camera;
  friend bool operator==(const PathKey&, const PathKey&) = default;
};

class CameraPath {
 public:
  // Stands still.
  static CameraPath still(const Camera& camera);
  // Once round the vertical axis through the target, counter-clockwise seen from above; t = 1 is where t = 0
  // was.
  static CameraPath orbit(const Camera& camera);
  // Straight ahead, looking where the camera looks, until a tenth of the way to the target is left.
  static CameraPath linear(const Camera& camera);
  // The same way in three straight legs of equal time, 45 degrees to the left, to the right and to the left
  // again, looking where it goes: what is in view changes at once at 1/3 and 2/3 (000, figure 6.6).
  static CameraPath zigzag(const Camera& camera);
  // Through the keys, smoothly (cubic Hermite with the tangents of a non-uniform Catmull-Rom spline; the path
  // passes through every key exactly). Times must ascend strictly; they are mapped to t in [0, 1].
  static Result<CameraPath> through(std::vector<PathKey> keys);

  Camera at(double t) const;
  bool closed() const { return kind_ == Kind::orbit; }

  // The moment of frame i of n: an orbit's last frame is one step before its first, so that the frames loop;
  // every other path ends with its end.
  double moment(std::size_t frame, std::size_t count) const;

 private:
  enum class Kind { still, orbit, linear, zigzag, keys };
  CameraPath(Kind kind, std::vector<PathKey> keys) : kind_(kind), keys_(std::move(keys)) {}
  Camera on_leg(double t) const;
  Camera between_keys(double t) const;

  Kind kind_;
  std::vector<PathKey> keys_;  // at least one
};

}  // namespace copse
