// Frames of three orthonormal axes, and rotations of them by Rodrigues vectors (axis times the tangent of
// half the angle), for which composition and the rotated coordinates are rational.
#pragma once

#include "lib/formats/vec.h"

#include <array>

namespace copse {

using Axes = std::array<Double3, 3>;  // right-handed

inline constexpr Axes k_world_axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

inline Double3 rotated(const Double3& u, const Double3& rodrigues) {
  const double s = dot(rodrigues, rodrigues);
  const Double3 t = cross(rodrigues, u);
  return u + (t + cross(rodrigues, t)) * (2 / (1 + s));
}

// Each axis rotated by the vector whose components are along the axes themselves, and made orthonormal again.
inline Axes rotated(const Axes& axes, const Double3& components) {
  const Double3 r = axes[0] * components.x + axes[1] * components.y + axes[2] * components.z;
  const Double3 u = normalized(rotated(axes[0], r));
  const Double3 v = rotated(axes[1], r);
  const Double3 w = normalized(cross(u, v));
  return {u, cross(w, u), w};
}

// Orthonormal axes with the first along `first` and the second as near to `second` as can be. Both must have
// a direction, and not the same one.
inline Axes axes_along(const Double3& first, const Double3& second) {
  const Double3 u = normalized(first), w = normalized(cross(u, second));
  return {u, normalized(cross(w, u)), w};
}

// A unit vector across `a`, always the same one.
inline Double3 any_normal(const Double3& a) {
  const double x = std::abs(a.x), y = std::abs(a.y), z = std::abs(a.z);
  const Double3 least = x <= y && x <= z ? Double3{1, 0, 0} : y <= z ? Double3{0, 1, 0} : Double3{0, 0, 1};
  return normalized(cross(a, least));
}

}  // namespace copse
