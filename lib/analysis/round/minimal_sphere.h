// minimal_sphere: the smallest ball that encloses a set of points or balls, and the same as float32 that
// still encloses.
//
// Source: the pivoting scheme of B. Gaertner, "Fast and robust smallest enclosing balls" (ESA 1999): the ball
// of a support set of at most four members is enlarged by the farthest one until none lies outside. Here a
// step tries every subset of the old support together with the new member and keeps the centre from which the
// farthest of these (at most five) is nearest; so no step depends on a tolerance, and duplicated, collinear,
// coplanar and cospherical points need no case of their own.
#pragma once

#include "lib/formats/vec.h"
#include "lib/formats/volumes/volume.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace copse {

using Sphere = BoundingSphere<double>;
using StoredSphere = BoundingSphere<float>;

// The smallest ball of at most four balls (points: radius 0), enlarged one by one. Callers that do not hold
// their points in one array (a hierarchy, a stream) drive it themselves: include the farthest until it is
// inside.
class SupportBall {
 public:
  // The smallest ball of the support and `b`. Balls so large or so small that squares leave the range of
  // double are the caller's to scale.
  void include(const Sphere& b);
  const Double3& centre() const { return ball_.centre; }
  double radius() const { return ball_.radius; }  // a lower bound of any enclosing ball's
  std::span<const Sphere> support() const { return {support_.data(), static_cast<std::size_t>(size_)}; }

 private:
  Sphere ball_;
  std::array<Sphere, 4> support_;
  int size_ = 0;
};

// Decides when to stop including: tells true while the farthest member is outside by more than rounding and
// steps still get somewhere, and remembers the best centre seen.
class PivotLoop {
 public:
  // `farthest`: from ball.centre(), over everything that is to be enclosed.
  bool should_include(const SupportBall& ball, double farthest);
  const Sphere& best() const { return best_; }  // its radius reaches the farthest

 private:
  Sphere best_{{}, -1};
  double radius_ = 0;
  int idle_ = 0;
};

struct MinimalSphere {
  Sphere sphere;
  double lower_radius = 0;  // of the support's ball: no enclosing sphere is smaller, but for rounding
  std::vector<std::uint32_t> support;  // at most 4 of the points, ascending, which this ball touches
};

// Finite points; no points give radius 0 at the origin. The ball encloses every point but for the rounding of
// the distance itself; its radius is within 1e-12 of the smallest one's, or within the rounding of the
// centre's coordinates where that is coarser (points far from the origin: pass them relative to something
// near). Expected O(n): some five passes over all points and a few over the outermost. Not one bit depends on
// the order of the points.
MinimalSphere minimal_sphere_and_support(std::span<const Double3> points);
// The same of points whose box is known.
MinimalSphere minimal_sphere_and_support(std::span<const Double3> points, const DoubleBox& box);
Sphere minimal_sphere(std::span<const Double3> points);

// The same of balls (radii >= 0).
Sphere minimal_sphere(std::span<const Sphere> balls);

// p as float32 stores it. GCC 12 (-O2 and -O3, SLP vectorizer) drops the rounding of to_double(to_float(p))
// when it sees both at once, and with it the proof that something encloses *as stored*; this keeps it.
Double3 rounded_to_float(const Double3& p);

// The smallest float32 radius about `centre` that is proven to reach every added point: float32 squares are
// exact in double, and the error of the squared distance is bounded.
class EnclosingRadius {
 public:
  explicit EnclosingRadius(const Float3& centre) : centre_(rounded_to_float(to_double(centre))) {}
  void add(const Double3& p) {
    const Double3 d = p - centre_;
    const double squared = dot(d, d);
    if (squared > squared_) squared_ = squared;
    const double reach = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    if (reach > reach_) reach_ = reach;
  }
  void add(const StoredSphere& s);
  float radius() const;

 private:
  Double3 centre_;
  double squared_ = 0;
  double reach_ = 0;  // largest coordinate difference: what is left when squares underflow
  double ball_ = 0;   // reaches the far side of every added sphere
};

// minimal_sphere with its centre rounded to float32 and the radius that encloses from there.
StoredSphere stored_minimal_sphere(std::span<const Double3> points);
StoredSphere stored_minimal_sphere(std::span<const StoredSphere> spheres);

// True when `p` is proven to lie inside; false when it lies outside or within a few roundings of the surface.
bool encloses(const StoredSphere& sphere, const Double3& p);

}  // namespace copse
