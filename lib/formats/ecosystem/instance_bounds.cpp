#include "lib/formats/ecosystem/instance_bounds.h"

#include "lib/formats/ecosystem/instance_codec.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace copse {
namespace {

// Of vectors of ordinary length; std::hypot costs ten times as much.
double size_of(const Double3& v) {
  return std::sqrt(dot(v, v));
}

using Axes = std::array<Vec3<float>, 3>;

// The columns of the inverse of the matrix whose rows are `axes`: axes that are stored as float32 are not
// quite orthogonal, and a box is what its inequalities say.
std::array<Double3, 3> dual(const Axes& axes) {
  const Double3 a = to_double(axes[0]), b = to_double(axes[1]), c = to_double(axes[2]);
  const double volume = dot(a, cross(b, c));
  return {cross(b, c) / volume, cross(c, a) / volume, cross(a, b) / volume};
}

struct Reach {
  Double3 e;

  double along(const Float3& p) const { return dot(to_double(p), e); }

  double operator()(const Box<float>& v) const {
    double sum = 0;
    for (int a = 0; a < 3; ++a)
      sum += std::max(e[a] * static_cast<double>(v.min[a]), e[a] * static_cast<double>(v.max[a]));
    return sum;
  }
  double operator()(const BoundingSphere<float>& v) const {
    return along(v.centre) + double{v.radius} * size_of(e);
  }
  double operator()(const OrientedBox<float>& v) const {
    double sum = along(v.centre);
    const auto g = dual(v.axes);
    for (int i = 0; i < 3; ++i)
      sum += static_cast<double>(v.half_extents[i]) * std::abs(dot(g[static_cast<std::size_t>(i)], e));
    return sum;
  }
  double operator()(const Capsule<float>& v) const {
    return std::max(along(v.a), along(v.b)) + double{v.radius} * size_of(e);
  }
  double operator()(const Cylinder<float>& v) const {
    const Double3 d = to_double(v.b) - to_double(v.a);
    return std::max(along(v.a), along(v.b)) + double{v.radius} * size_of(cross(e, d)) / size_of(d);
  }
  double operator()(const Lozenge<float>& v) const {
    return along(v.origin) + std::max(along(v.edge0), 0.0) + std::max(along(v.edge1), 0.0) +
           double{v.radius} * size_of(e);
  }
  double operator()(const Ellipsoid<float>& v) const {
    double squares = 0;
    const auto g = dual(v.axes);
    for (int i = 0; i < 3; ++i) {
      const double part = static_cast<double>(v.semi_axes[i]) * dot(g[static_cast<std::size_t>(i)], e);
      squares += part * part;
    }
    return along(v.centre) + std::sqrt(squares);
  }
  double operator()(const Kdop<float>&) const { return std::numeric_limits<double>::infinity(); }
};

double size_of(const FloatBox& box) {
  return size_of(to_double(box.min)) + size_of(to_double(box.max));
}

// What some dozens of roundings make of numbers of one size.
constexpr double k_rounding = 1e-14;

}  // namespace

double reach_of(const Volume<float>& volume, const Double3& direction) {
  return std::visit(Reach{direction}, volume);
}

DoubleBox instance_bounds(const TreeType& type, const Instance& instance) {
  if (type.bounds.empty()) return {};
  const bool sways = instance.motion != 0 && !type.envelopes.empty();
  const DoubleBox still = transformed(type.bounds, instance);
  if (!sways && type.volumes.empty()) return still;
  const Quaternion& q = instance.rotation;
  const Quaternion back{-q[0], -q[1], -q[2], q[3]};
  DoubleBox box;
  for (int a = 0; a < 3; ++a) {
    Double3 axis;
    axis[a] = 1;
    const Double3 e = rotate(back, axis);  // the transpose of rotate(q, .), whatever the length of q
    double high = std::numeric_limits<double>::infinity(), low = high;
    for (const Volume<float>& v : sways ? type.envelopes : type.volumes) {
      high = std::min(high, reach_of(v, e));
      low = std::min(low, reach_of(v, -e));
    }
    const double slack = k_rounding * (size_of(type.bounds) + std::abs(high) + std::abs(low));
    const double at = instance.position[a];
    high = at + instance.scale * (high + slack), low = at - instance.scale * (low + slack);
    box.max[a] = sways ? high : std::min(still.max[a], high);
    box.min[a] = sways ? low : std::max(still.min[a], low);
  }
  return box;
}

}  // namespace copse
