// Turning vectors.
#pragma once

#include "lib/formats/vec.h"

#include <cmath>
#include <numbers>

namespace copse::grow {

inline constexpr Double3 k_up{0, 1, 0};
inline constexpr double k_degree = std::numbers::pi / 180;

// `v` turned about the unit vector `axis`, counter-clockwise seen from its tip (Rodrigues).
inline Double3 rotated(const Double3& v, const Double3& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return v * c + cross(axis, v) * s + axis * (dot(axis, v) * (1 - c));
}

// A unit vector at right angles to the unit vector `v`, as near to `wish` as can be.
inline Double3 perpendicular(const Double3& v, const Double3& wish) {
  const Double3 p = wish - v * dot(wish, v);
  if (length(p) > 1e-6) return normalized(p);  // of unit vectors: the rest is cancellation
  const Double3 other = std::abs(v.x) < 0.8 ? Double3{1, 0, 0} : Double3{0, 0, 1};
  return normalized(other - v * dot(other, v));
}

// Turns the unit vector `v` by at most `angle` towards the unit vector `target`.
inline Double3 turned_towards(const Double3& v, const Double3& target, double angle) {
  const double away = std::atan2(length(cross(v, target)), dot(v, target));
  if (away < 1e-9 || away > std::numbers::pi - 1e-9) return v;
  return normalized(rotated(v, normalized(cross(v, target)), std::fmin(angle, away)));
}

}  // namespace copse::grow
