#include "lib/analysis/hull/point_cloud.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace copse {
namespace {

constexpr int k_origin_bits =
    4;  // the origin is a multiple of 2^-4 of the scale, where that can be represented

// x rounded to a multiple of `unit` (a power of two); x itself where it has no bits below.
double rounded_to(double x, double unit) {
  const double multiple = x / unit;
  return std::abs(multiple) < 0x1p52 ? std::nearbyint(multiple) * unit : x;
}

PointFrame frame_of(const DoubleBox& box) {
  // Halves first: the box of points near the largest double must not overflow.
  const Double3 half = box.max * 0.5 - box.min * 0.5;
  const double reach = std::max({half.x, half.y, half.z});
  PointFrame frame;
  if (reach > 0) frame.scale = std::ldexp(1.0, std::clamp(std::ilogb(reach) + 1, -1000, 1023));
  const double unit = std::ldexp(frame.scale, -k_origin_bits);
  for (int i = 0; i < 3; ++i) frame.origin[i] = rounded_to(box.min[i] + half[i], unit);
  return frame;
}

// Sums that are not finite give the bad point away without a test a coordinate.
bool all_finite(std::span<const Double3> points) {
  double x = 0, y = 0, z = 0;
  for (const Double3& p : points) x += p.x * 0, y += p.y * 0, z += p.z * 0;
  return x == 0 && y == 0 && z == 0;
}

}  // namespace

Result<PointCloud> make_point_cloud(std::span<const Double3> points) {
  if (points.empty()) return refuse("", "there are no points", "give at least one point to enclose");
  if (!all_finite(points)) {
    const auto bad =
        std::find_if_not(points.begin(), points.end(), [](const Double3& p) { return is_finite(p); });
    return refuse("", fmt::format("point {} is ({}, {}, {})", bad - points.begin(), bad->x, bad->y, bad->z),
                  "every coordinate must be a finite number: correct or remove the point");
  }
  PointCloud cloud;
  for (const Double3& p : points) cloud.box.grow(p);
  cloud.frame = frame_of(cloud.box);
  cloud.box = {cloud.frame.in(cloud.box.min), cloud.frame.in(cloud.box.max)};
  cloud.points.resize(points.size());
  std::transform(points.begin(), points.end(), cloud.points.begin(),
                 [frame = cloud.frame](const Double3& p) { return frame.in(p); });
  return cloud;
}

std::vector<Double3> distinct_points(std::span<const Double3> points) {
  std::vector<Double3> distinct(points.begin(), points.end());
  std::sort(distinct.begin(), distinct.end(), lexicographically_less);
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  return distinct;
}

DoubleBox placed(const DoubleBox& v, const PointFrame& frame) {
  return {frame.out(v.min), frame.out(v.max)};
}
BoundingSphere<double> placed(const BoundingSphere<double>& v, const PointFrame& frame) {
  return {frame.out(v.centre), v.radius * frame.scale};
}
OrientedBox<double> placed(const OrientedBox<double>& v, const PointFrame& frame) {
  return {frame.out(v.centre), v.axes, v.half_extents * frame.scale};
}
Capsule<double> placed(const Capsule<double>& v, const PointFrame& frame) {
  return {frame.out(v.a), frame.out(v.b), v.radius * frame.scale};
}
Cylinder<double> placed(const Cylinder<double>& v, const PointFrame& frame) {
  return {frame.out(v.a), frame.out(v.b), v.radius * frame.scale};
}
Lozenge<double> placed(const Lozenge<double>& v, const PointFrame& frame) {
  return {frame.out(v.origin), v.edge0 * frame.scale, v.edge1 * frame.scale, v.radius * frame.scale};
}
Ellipsoid<double> placed(const Ellipsoid<double>& v, const PointFrame& frame) {
  return {frame.out(v.centre), v.axes, v.semi_axes * frame.scale};
}
Kdop<double> placed(const Kdop<double>& v, const PointFrame& frame) {
  Kdop<double> out = v;
  for (std::size_t i = 0; i < v.normals.size(); ++i) {
    const double shift = dot(v.normals[i], frame.origin);
    out.min[i] = v.min[i] * frame.scale + shift;
    out.max[i] = v.max[i] * frame.scale + shift;
  }
  return out;
}
Volume<double> placed(const Volume<double>& v, const PointFrame& frame) {
  return std::visit([&](const auto& one) -> Volume<double> { return placed(one, frame); }, v);
}

}  // namespace copse
