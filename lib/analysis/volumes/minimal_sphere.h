// minimal_sphere: the smallest ball that encloses a set of points, and the same as float32 that still
// encloses.
//
// Source: the pivoting scheme of B. Gaertner, "Fast and robust smallest enclosing balls" (ESA 1999): the ball
// of a support set of at most four points is enlarged by the farthest point until none lies outside. Here a
// step tries every subset of the old support together with the new point and keeps the centre from which the
// farthest of these (at most five) points is nearest; so no step depends on a tolerance, and duplicated,
// collinear, coplanar and cospherical points need no case of their own.
#pragma once

#include "lib/formats/vec.h"

#include <array>
#include <cstdint>
#include <span>

namespace copse {

struct Sphere {
  Double3 centre;
  double radius = 0;
};

struct StoredSphere {
  Float3 centre;
  float radius = 0;
};

// The smallest ball of at most four support points, enlarged point by point. Callers that do not hold their
// points in one array (a hierarchy, a stream) drive it themselves: include the farthest point until it is
// inside.
class SupportBall {
 public:
  // The smallest ball of the support and `p`. Points so large or so small that squares leave the range of
  // double are the caller's to scale.
  void include(const Double3& p);
  bool empty() const { return size_ == 0; }
  const Double3& centre() const { return centre_; }
  double squared_radius() const { return squared_radius_; }  // a lower bound of any enclosing ball's
  std::span<const Double3> support() const { return {support_.data(), static_cast<std::size_t>(size_)}; }

 private:
  Double3 centre_;
  double squared_radius_ = 0;
  std::array<Double3, 4> support_;
  int size_ = 0;
};

// Decides when to stop including: tells true while the farthest point is outside by more than rounding and
// steps still get somewhere, and remembers the best centre seen.
class PivotLoop {
 public:
  bool should_include(const SupportBall& ball, double farthest_squared);
  const Double3& best_centre() const { return best_centre_; }
  double best_squared() const { return best_squared_; }

 private:
  Double3 best_centre_;
  double best_squared_ = -1;
  double radius_squared_ = 0;
  int idle_ = 0;
};

// Finite points; no points give radius 0 at the origin. The ball encloses every point but for the rounding of
// the distance itself; its radius is within 1e-12 of the smallest one's, or within the rounding of the
// centre's coordinates where that is coarser (points far from the origin: pass them relative to something
// near). Expected O(n): some ten passes, each over all points.
Sphere minimal_sphere(std::span<const Double3> points);

// The smallest float32 radius about `centre` that is proven to reach every added point: float32 squares are
// exact in double, and the error of the squared distance is bounded.
class EnclosingRadius {
 public:
  explicit EnclosingRadius(const Float3& centre) : centre_(to_double(centre)) {}
  void add(const Double3& p) {
    const Double3 d = p - centre_;
    const double squared = dot(d, d);
    if (squared > squared_) squared_ = squared;
    const double reach = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    if (reach > reach_) reach_ = reach;
  }
  float radius() const;

 private:
  Double3 centre_;
  double squared_ = 0;
  double reach_ = 0;  // largest coordinate difference: what is left when squares underflow
};

// minimal_sphere with its centre rounded to float32 and the radius that encloses from there.
StoredSphere stored_minimal_sphere(std::span<const Double3> points);

// True when `p` is proven to lie inside; false when it lies outside or within a few roundings of the surface.
bool encloses(const StoredSphere& sphere, const Double3& p);

}  // namespace copse
