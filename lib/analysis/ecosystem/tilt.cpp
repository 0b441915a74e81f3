#include "lib/analysis/ecosystem/tilt.h"

#include "lib/analysis/ecosystem/degrees.h"
#include "lib/formats/ecosystem/instance_codec.h"

#include <cmath>
#include <numbers>

namespace copse {
namespace {

constexpr double k_degrees = 180 / std::numbers::pi;

Quaternion product(const Quaternion& a, const Quaternion& b) {
  return {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
          a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
          a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
          a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
}

}  // namespace

Double3 upward(const Double3& n) {
  const double largest = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
  if (!(largest > 0) || !is_finite(n)) return {0, 1, 0};
  const Double3 s = n / (n.y < 0 ? -largest : largest);  // no overflow at any size
  const double l = std::sqrt(dot(s, s));
  return {s.x / l, s.y / l, s.z / l};
}

Quaternion tilt_to(const Double3& normal) {
  const double w = 1 + normal.y;  // at least 1: never the half turn, where there is no shortest way
  const double l = std::sqrt(w * w + normal.x * normal.x + normal.z * normal.z);
  return {normal.z / l, 0, -normal.x / l, w / l};
}

Quaternion tilt_of(double pitch, double roll) {
  const SinCos x = sin_cos_degrees(pitch / 2), z = sin_cos_degrees(roll / 2);
  return product({0, 0, z.sin, z.cos}, {x.sin, 0, 0, x.cos});
}

Quaternion with_head(const Quaternion& tilt, double head) {
  const SinCos y = sin_cos_degrees(head / 2);
  return product(tilt, {0, y.sin, 0, y.cos});
}

Quaternion leaned(const Quaternion& rotation, const Double3& normal) {
  const Double3 axis = rotate(rotation, {0, 1, 0}), off = axis - normal;
  if (dot(off, off) < 1e-28) return rotation;  // it is the one, but for rounding
  const Quaternion was = tilt_to(axis);
  return product(tilt_to(normal), product({-was[0], -was[1], -was[2], was[3]}, rotation));
}

Angles angles_of(const Quaternion& rotation) {
  const Double3 up = rotate(rotation, {0, 1, 0});
  Angles a;
  a.roll = std::atan2(-up.x, up.y) * k_degrees;
  a.pitch = std::atan2(up.z, std::sqrt(up.x * up.x + up.y * up.y)) * k_degrees;
  const Quaternion tilt = tilt_of(a.pitch, a.roll);
  const Quaternion head = product({-tilt[0], -tilt[1], -tilt[2], tilt[3]}, rotation);
  a.head = 2 * std::atan2(head[1], head[3]) * k_degrees;
  if (a.head > 180) a.head -= 360;
  if (a.head <= -180) a.head += 360;
  return a;
}

Angles thesis_tilt(const Double3& normal) {
  return {0, std::atan2(normal.z, normal.y) * k_degrees, std::atan2(-normal.x, normal.y) * k_degrees};
}

double thesis_tilt_error(const Double3& normal) {
  const Angles a = thesis_tilt(normal);
  const Double3 up = rotate(tilt_of(a.pitch, a.roll), {0, 1, 0});
  return std::atan2(length(cross(up, normal)), dot(up, normal)) * k_degrees;
}

}  // namespace copse
