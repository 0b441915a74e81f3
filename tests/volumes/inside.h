// How far points leave a volume, straight from the inequalities of lib/formats/volumes/volume.h.
#pragma once

#include "lib/formats/volumes/volume.h"
#include "tests/volumes/point_sets.h"

#include <span>

namespace copse {

inline double outside_by(const BoundingSphere<double>& v, const Double3& p) {
  return distance(p, v.centre) - v.radius;
}
inline double outside_by(const OrientedBox<double>& v, const Double3& p) {
  double worst = 0;
  for (int i = 0; i < 3; ++i)
    worst = std::max(worst, std::abs(dot(v.axes[i], p - v.centre)) - v.half_extents[i]);
  return worst;
}
inline double outside_by(const Cylinder<double>& v, const Double3& p) {
  const Double3 d = normalized(v.b - v.a), q = p - v.a;
  const double t = dot(q, d);
  return std::max({-t, t - distance(v.a, v.b), length(q - d * t) - v.radius});
}
inline double outside_by(const Ellipsoid<double>& v, const Double3& p) {
  Double3 q;
  double off = 0;
  for (int i = 0; i < 3; ++i) {
    const double c = dot(v.axes[i], p - v.centre);
    if (v.semi_axes[i] > 0) {
      q[i] = c / v.semi_axes[i];
    } else {
      off = std::max(off, std::abs(c));
    }
  }
  return std::max(off, (length(q) - 1) * std::max({v.semi_axes.x, v.semi_axes.y, v.semi_axes.z}));
}
inline double outside_by(const Kdop<double>& v, const Double3& p) {
  double worst = 0;
  for (std::size_t i = 0; i < v.normals.size(); ++i) {
    const double d = dot(v.normals[i], p);
    worst = std::max({worst, (v.min[i] - d) / length(v.normals[i]), (d - v.max[i]) / length(v.normals[i])});
  }
  return worst;
}
template <class V>
double outside_by(const V& v, std::span<const Double3> points) {
  double worst = 0;
  for (const Double3& p : points) worst = std::max(worst, outside_by(v, p));
  return worst;
}

}  // namespace copse
