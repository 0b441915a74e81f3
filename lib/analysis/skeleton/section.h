// section: the circle that stands for a limb where a plane cuts it.
#pragma once

#include "lib/analysis/surface/bands.h"
#include "lib/analysis/surface/surface.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace copse {

class Sections {
 public:
  explicit Sections(const Surface& surface);

  // Where the plane through `point` at right angles to the unit vector `normal` cuts the surface: the outline
  // round `point` that goes through one of `seeds` (triangles near by), or, when none goes round it, the
  // longest one. Centre and radius count the outline's corners by how much it turns there, so that on a tube
  // of rings they are the rings' own centre and 1/k sum |v - c|, however its quads are cut; an outline that
  // is far from convex counts by its length instead. Returns false, and leaves `circle` alone, when the plane
  // misses the seeds, or when all cuts so far have passed so many triangles that the surface cannot be made
  // of limbs (welded_tolerances.h: a heap of triangles is cut through all of them every time). Linear in the
  // outline and the seeds.
  bool cut(const Double3& point, const Double3& normal, std::span<const std::uint32_t> seeds,
           RingCircle& circle);

  // The same of a closed line through `points`, seen along `normal`.
  RingCircle circle_round(std::span<const Double3> points, const Double3& normal);

 private:
  struct Outline {
    std::vector<Double3> points;
    double length = 0;
    bool around = false;
  };

  void look_along(const Double3& point, const Double3& normal);
  bool above(std::uint32_t v) const { return dot(s_.positions[v] - point_, normal_) >= 0; }
  Double3 crossing(std::uint32_t a, std::uint32_t b) const;
  std::uint32_t follow(std::uint32_t t, std::size_t edge, std::vector<Double3>& points);
  bool trace(std::uint32_t seed, Outline& outline);
  RingCircle circle_of(const Outline& outline) const;

  const Surface& s_;
  std::vector<std::uint32_t> seen_;
  std::uint32_t stamp_ = 0;
  std::size_t steps_left_;          // triangles that cuts may still pass
  Double3 point_, normal_, u_, v_;  // u, v, normal: a right-handed frame
};

}  // namespace copse
