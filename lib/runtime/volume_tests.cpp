#include "lib/runtime/volume_tests.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace copse {
namespace {

// Room for some sixteen roundings of what was added up.
constexpr float k_room = 0x1p-20f;
constexpr float k_tiny = std::numeric_limits<float>::min();

float sum_of(const Float3& v) {
  return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}
float largest_of(const Float3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}
float length_of(const Float3& v) {
  return std::sqrt(dot(v, v));
}
// Clamps; what is no number becomes 0.
float unit_interval(float t) {
  return t > 0 ? std::min(t, 1.0f) : 0.0f;
}

// Where along d (0 to 1) the foot of q lies. When squares of d vanish, any foot does: the room covers d.
float foot(const Float3& q, const Float3& d) {
  const float dd = dot(d, d);
  return dd > k_tiny ? unit_interval(dot(q, d) / dd) : 0.0f;
}

// The core of a swept volume: a point, a segment or a rectangle with a radius.
struct Core {
  Float3 origin, edge0, edge1;
  float radius = 0;
  float room(const Float3& q) const {
    return k_room * (sum_of(q) + sum_of(edge0) + sum_of(edge1) + radius) +
           (vanishes(edge0) + vanishes(edge1));
  }
  Float3 rest(const Float3& q) const { return q - edge0 * foot(q, edge0) - edge1 * foot(q, edge1); }
  Float3 centre() const { return origin + edge0 * 0.5f + edge1 * 0.5f; }
  float reach() const { return radius + 0.5f * (sum_of(edge0) + sum_of(edge1)); }

 private:
  static float vanishes(const Float3& e) { return dot(e, e) > k_tiny ? 0.0f : sum_of(e); }
};
Core core_of(const BoundingSphere<float>& v) {
  return {v.centre, {}, {}, v.radius};
}
Core core_of(const Capsule<float>& v) {
  return {v.a, v.b - v.a, {}, v.radius};
}
Core core_of(const Lozenge<float>& v) {
  return {v.origin, v.edge0, v.edge1, v.radius};
}

// |d| <= r, unless that is proven wrong.
bool within(const Float3& d, float r) {
  return !(dot(d, d) > r * r);
}

// An interval of the distances of a volume from a plane through its middle, or along an axis.
struct Interval {
  float low = 0, high = 0;
};

// --- extents along a direction n: what dot(n, p) can be, rounded outward
// -------------------------------------

Interval about(float middle, float half, float size) {
  const float room = k_room * size;
  return {middle - half - room, middle + half + room};
}
float size_along(const Float3& n, const Float3& p) {
  return std::abs(n.x * p.x) + std::abs(n.y * p.y) + std::abs(n.z * p.z);
}

Interval along(const FloatBox& v, const Float3& n) {
  const float low = n.x * (n.x > 0 ? v.min.x : v.max.x) + n.y * (n.y > 0 ? v.min.y : v.max.y) +
                    n.z * (n.z > 0 ? v.min.z : v.max.z);
  const float high = n.x * (n.x > 0 ? v.max.x : v.min.x) + n.y * (n.y > 0 ? v.max.y : v.min.y) +
                     n.z * (n.z > 0 ? v.max.z : v.min.z);
  const float room = k_room * (size_along(n, v.min) + size_along(n, v.max));
  return {low - room, high + room};
}
Interval along(const Core& c, const Float3& n) {
  const float at = dot(n, c.origin), e0 = dot(n, c.edge0), e1 = dot(n, c.edge1), r = c.radius * length_of(n);
  const float room = k_room * (size_along(n, c.origin) + size_along(n, c.edge0) + size_along(n, c.edge1) + r);
  return {at + std::min(e0, 0.0f) + std::min(e1, 0.0f) - r - room,
          at + std::max(e0, 0.0f) + std::max(e1, 0.0f) + r + room};
}
Interval along(const BoundingSphere<float>& v, const Float3& n) {
  return along(core_of(v), n);
}
Interval along(const Capsule<float>& v, const Float3& n) {
  return along(core_of(v), n);
}
Interval along(const Lozenge<float>& v, const Float3& n) {
  return along(core_of(v), n);
}
// axes are unit and orthogonal up to their rounding, so points can stick out by as much
Interval along(const OrientedBox<float>& v, const Float3& n) {
  float half = 0;
  for (int i = 0; i < 3; ++i)
    half += v.half_extents[i] * std::abs(dot(n, v.axes[static_cast<std::size_t>(i)]));
  return about(dot(n, v.centre), half, size_along(n, v.centre) + sum_of(v.half_extents) * sum_of(n));
}
Interval along(const Ellipsoid<float>& v, const Float3& n) {
  float squared = 0;
  for (int i = 0; i < 3; ++i) {
    const float t = v.semi_axes[i] * dot(n, v.axes[static_cast<std::size_t>(i)]);
    squared += t * t;
  }
  return about(dot(n, v.centre), std::sqrt(squared),
               size_along(n, v.centre) + sum_of(v.semi_axes) * sum_of(n));
}
Interval along(const Cylinder<float>& v, const Float3& n) {
  const Float3 d = v.b - v.a;
  const float l = length_of(d), at = dot(n, v.a), end = dot(n, v.b);
  const float nn = dot(n, n), cosine = l > 0 ? dot(n, d) / l : 0.0f;
  // sqrt magnifies a rounding near 0: the room goes under the root
  const float half = v.radius * std::sqrt(std::max(0.0f, nn - cosine * cosine) + k_room * nn);
  const float room = k_room * (size_along(n, v.a) + size_along(n, v.b) + half);
  return {std::min(at, end) - half - room, std::max(at, end) + half + room};
}
// n as a sum of slab normals bounds what is inside all slabs. The first three normals and one other: tight
// when n is near that one.
Interval along(const Kdop<float>& v, const Float3& n) {
  constexpr float k_infinity = std::numeric_limits<float>::infinity();
  Interval best{-k_infinity, k_infinity};
  if (v.normals.size() < 3) return best;
  const Float3 &a = v.normals[0], &b = v.normals[1], &c = v.normals[2];
  const float det = dot(a, cross(b, c));
  const auto add = [&](Interval& sum, float weight, std::size_t slab, float& size) {
    sum.low += weight * (weight > 0 ? v.min[slab] : v.max[slab]);
    sum.high += weight * (weight > 0 ? v.max[slab] : v.min[slab]);
    size += std::abs(weight) * (std::abs(v.min[slab]) + std::abs(v.max[slab]));
  };
  for (std::size_t j = 2; j < v.normals.size(); ++j) {
    const float weight = j == 2 ? 0.0f : dot(n, v.normals[j]) / dot(v.normals[j], v.normals[j]);
    const Float3 rest = n - v.normals[j] * weight;
    Interval sum;
    float size = 0;
    if (weight != 0) add(sum, weight, j, size);
    add(sum, dot(rest, cross(b, c)) / det, 0, size);
    add(sum, dot(rest, cross(c, a)) / det, 1, size);
    add(sum, dot(rest, cross(a, b)) / det, 2, size);
    // weights are rounded too: what they leave of n meets points no larger than the slabs allow
    const float room = 4 * k_room * size;
    if (!std::isfinite(sum.low) || !std::isfinite(sum.high)) continue;
    best.low = std::max(best.low, sum.low - room), best.high = std::min(best.high, sum.high + room);
  }
  return best;
}

// --- points
// --------------------------------------------------------------------------------------------------

bool holds(const FloatBox& v, const Float3& p) {
  return v.min.x <= p.x && p.x <= v.max.x && v.min.y <= p.y && p.y <= v.max.y && v.min.z <= p.z &&
         p.z <= v.max.z;
}
bool holds(const Core& c, const Float3& p) {
  const Float3 q = p - c.origin;
  return within(c.rest(q), c.radius + c.room(q));
}
bool holds(const BoundingSphere<float>& v, const Float3& p) {
  return holds(core_of(v), p);
}
bool holds(const Capsule<float>& v, const Float3& p) {
  return holds(core_of(v), p);
}
bool holds(const Lozenge<float>& v, const Float3& p) {
  return holds(core_of(v), p);
}
bool holds(const OrientedBox<float>& v, const Float3& p) {
  const Float3 d = p - v.centre;
  const float room = k_room * sum_of(d);
  bool inside = true;
  for (int i = 0; i < 3; ++i)
    inside &= !(std::abs(dot(v.axes[static_cast<std::size_t>(i)], d)) > v.half_extents[i] + room);
  return inside;
}
bool holds(const Cylinder<float>& v, const Float3& p) {
  const Float3 q = p - v.a, d = v.b - v.a;
  const float dd = dot(d, d), l = std::sqrt(dd), room = k_room * (sum_of(q) + sum_of(d) + v.radius);
  if (!(dd > k_tiny)) return within(q, v.radius + sum_of(d) + room);
  const float t = dot(q, d) / l;
  if (t < -room || t > l + room) return false;
  return within(q - d * (t / l), v.radius + room);
}
bool holds(const Ellipsoid<float>& v, const Float3& p) {
  const Float3 d = p - v.centre;
  const float room = k_room * sum_of(d);
  float sum = 0;
  for (int i = 0; i < 3; ++i) {
    const float x = std::max(0.0f, std::abs(dot(v.axes[static_cast<std::size_t>(i)], d)) - room);
    if (x > 0) sum += (x / v.semi_axes[i]) * (x / v.semi_axes[i]);
  }
  return !(sum > 1 + k_room);
}
bool holds(const Kdop<float>& v, const Float3& p) {
  bool inside = true;
  for (std::size_t i = 0; i < v.normals.size(); ++i) {
    const float x = dot(v.normals[i], p), room = k_room * size_along(v.normals[i], p);
    inside &= !(x < v.min[i] - room || x > v.max[i] + room);
  }
  return inside;
}

// --- rays
// ----------------------------------------------------------------------------------------------------

// The part of a ray that can matter to a volume, from its point nearest to the volume's middle: nothing far
// away is squared.
struct Stretch {
  Float3 origin;  // relative to the volume's middle
  Float3 direction;
  float from = 0, to = 0;
  float room = 0;
};
Stretch stretch_of(const FloatRay& ray, const Float3& middle, float reach) {
  const Float3 q = ray.origin - middle;
  const float nearest = -dot(q, ray.direction);
  const float room = 4 * k_room * (sum_of(q) + reach);
  const float half = 2 * reach + room;
  return {q + ray.direction * nearest, ray.direction, std::max(-nearest, -half),
          std::min(ray.length - nearest, half), room};
}

float distance_to_core(const Core& c, const Float3& p) {
  return length_of(c.rest(p - c.origin));
}
// Between the segments p + s d and q + t e, 0 <= s, t <= 1: at an end of one of them, or where both are
// straight. There s comes from products with cross(d, e) and t from s: however small the angle, what is
// rounded moves the distance by a few roundings of the lengths (dd ee - de de would cancel).
float segment_distance(const Float3& p, const Float3& d, const Float3& q, const Float3& e) {
  const Core first{p, d, {}, 0}, second{q, e, {}, 0};
  const Float3 n = cross(d, e);
  const float s = unit_interval(dot(cross(e, p - q), n) / dot(n, n));
  return std::min({distance_to_core(first, q), distance_to_core(first, q + e), distance_to_core(second, p),
                   distance_to_core(second, p + d), distance_to_core(second, p + d * s)});
}
bool crosses_rectangle(const Core& c, const Float3& p, const Float3& d) {
  const Float3 n = cross(c.edge0, c.edge1);
  const float a = dot(n, p - c.origin), slope = dot(n, d);
  const float s = -a / slope;
  if (!(s >= 0 && s <= 1)) return false;
  const Float3 q = p + d * s - c.origin;
  const float t0 = dot(q, c.edge0), t1 = dot(q, c.edge1);
  return t0 >= 0 && t0 <= dot(c.edge0, c.edge0) && t1 >= 0 && t1 <= dot(c.edge1, c.edge1);
}
bool hit(const Core& whole, const FloatRay& ray) {
  const float scale = sum_of(ray.origin - whole.centre()) + whole.reach();
  if (!(scale * scale > k_tiny) || !std::isfinite(scale * scale)) return true;  // squares mean nothing
  const Stretch s = stretch_of(ray, whole.centre(), whole.reach());
  const float reach = whole.reach() + s.room;
  if (s.from > s.to) return s.from - s.to <= s.room;
  if (largest_of(s.origin) > reach) return false;
  // relative to the middle, as the stretch is, and in units of the reach: products of four lengths neither
  // overflow nor underflow
  const float unit = 1 / reach;
  Core c{{}, whole.edge0 * unit, whole.edge1 * unit, (whole.radius + s.room) * unit};
  c.origin = c.edge0 * -0.5f - c.edge1 * 0.5f;
  const Float3 p = (s.origin + s.direction * s.from) * unit, d = s.direction * ((s.to - s.from) * unit);
  if (crosses_rectangle(c, p, d)) return true;
  const Float3 corner = c.origin + c.edge0 + c.edge1;
  const float least =
      std::min({segment_distance(p, d, c.origin, c.edge0), segment_distance(p, d, c.origin, c.edge1),
                segment_distance(p, d, corner, -c.edge0), segment_distance(p, d, corner, -c.edge1),
                distance_to_core(c, p), distance_to_core(c, p + d)});
  return !(least > c.radius);
}
bool hit(const BoundingSphere<float>& v, const FloatRay& ray) {
  return hit(core_of(v), ray);
}
bool hit(const Capsule<float>& v, const FloatRay& ray) {
  return hit(core_of(v), ray);
}
bool hit(const Lozenge<float>& v, const FloatRay& ray) {
  return hit(core_of(v), ray);
}

// Cuts [from, to] to where low <= at + t slope <= high.
void cut(Stretch& s, float at, float slope, float low, float high) {
  low -= s.room, high += s.room;
  if (std::abs(slope) * (s.to - s.from) <= s.room) {  // all but parallel: the ends tell
    const float a = at + slope * s.from;
    if (a < low - s.room || a > high + s.room) s.to = s.from - 1 - 2 * s.room;
    return;
  }
  const float a = (low - at) / slope, b = (high - at) / slope;
  s.from = std::max(s.from, std::min(a, b)), s.to = std::min(s.to, std::max(a, b));
}
bool left(const Stretch& s) {
  return !(s.from > s.to + s.room);
}
bool hit_slabs(Stretch s, std::span<const Float3> normals, auto&& bounds) {
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const auto [low, high] = bounds(i);
    cut(s, dot(normals[i], s.origin), dot(normals[i], s.direction), low, high);
  }
  return left(s);
}
constexpr std::array<Float3, 3> k_axes{Float3{1, 0, 0}, Float3{0, 1, 0}, Float3{0, 0, 1}};

bool hit(const FloatBox& v, const FloatRay& ray) {
  const Float3 half = (v.max - v.min) * 0.5f, middle = v.min + half;
  return hit_slabs(stretch_of(ray, middle, sum_of(half)), k_axes, [&](std::size_t i) {
    return std::pair{-half[static_cast<int>(i)], half[static_cast<int>(i)]};
  });
}
bool hit(const OrientedBox<float>& v, const FloatRay& ray) {
  return hit_slabs(stretch_of(ray, v.centre, sum_of(v.half_extents)), v.axes, [&](std::size_t i) {
    return std::pair{-v.half_extents[static_cast<int>(i)], v.half_extents[static_cast<int>(i)]};
  });
}
bool hit(const Kdop<float>& v, const FloatRay& ray) {
  const Interval x = along(v, k_axes[0]), y = along(v, k_axes[1]), z = along(v, k_axes[2]);
  const Float3 half{(x.high - x.low) / 2, (y.high - y.low) / 2, (z.high - z.low) / 2};
  const Float3 middle{x.low + half.x, y.low + half.y, z.low + half.z};
  if (!is_finite(middle)) return true;
  Stretch s = stretch_of(ray, middle, sum_of(half));
  for (std::size_t i = 0; i < v.normals.size(); ++i) {
    const Float3& n = v.normals[i];
    const float at = dot(n, middle), room = k_room * size_along(n, middle);
    Stretch scaled = s;
    scaled.room = s.room * sum_of(n) + room;
    cut(scaled, dot(n, s.origin), dot(n, s.direction), v.min[i] - at, v.max[i] - at);
    s.from = scaled.from, s.to = scaled.to;
  }
  return left(s);
}
// Cuts to where |q + t e|^2 <= r^2, q and e being what is left of origin and direction across an axis or in
// units of semi-axes.
bool cut_round(Stretch& s, const Float3& q, const Float3& e, float r) {
  const float ee = dot(e, e), nearest = ee > k_tiny ? -dot(q, e) / ee : 0.0f;
  const float t = std::clamp(nearest, s.from, std::max(s.from, s.to));
  const Float3 p = q + e * nearest;
  const float rest = r * r - dot(p, p);
  if (ee > k_tiny && rest >= 0) {
    const float half = std::sqrt(rest / ee);
    s.from = std::max(s.from, nearest - half), s.to = std::min(s.to, nearest + half);
    return left(s);
  }
  return within(q + e * t, r);
}
bool hit(const Cylinder<float>& v, const FloatRay& ray) {
  const Float3 d = v.b - v.a;
  const float l = length_of(d);
  Stretch s = stretch_of(ray, v.a + d * 0.5f, v.radius + l);
  if (!(l > 0)) return true;
  const Float3 axis = d / l;
  cut(s, dot(axis, s.origin), dot(axis, s.direction), -l / 2, l / 2);
  if (!left(s)) return false;
  return cut_round(s, s.origin - axis * dot(axis, s.origin), s.direction - axis * dot(axis, s.direction),
                   v.radius + s.room);
}
bool hit(const Ellipsoid<float>& v, const FloatRay& ray) {
  Stretch s = stretch_of(ray, v.centre, sum_of(v.semi_axes));
  const float reach = sum_of(v.semi_axes) + s.room;  // the unit of what follows: e is squared
  Float3 q, e;
  for (int i = 0; i < 3; ++i) {
    const Float3& axis = v.axes[static_cast<std::size_t>(i)];
    const float semi = v.semi_axes[i] + 2 * s.room;
    if (!(semi > 0)) return true;
    q[i] = dot(axis, s.origin) / semi, e[i] = dot(axis, s.direction) * (reach / semi);
  }
  s.from /= reach, s.to /= reach, s.room /= reach;
  return cut_round(s, q, e, 1 + 16 * k_room);
}

// --- boxes and balls: apart when an axis separates them
// --------------------------------------------------------

template <class V>
bool apart(const V& v, const FloatBox& box, const Float3& n) {
  const Interval a = along(v, n), b = along(box, n);
  return a.high < b.low || b.high < a.low;
}
Float3 nearest_in(const FloatBox& box, const Float3& p) {
  return {std::clamp(p.x, box.min.x, box.max.x), std::clamp(p.y, box.min.y, box.max.y),
          std::clamp(p.z, box.min.z, box.max.z)};
}
template <class V>
bool apart_on_axes(const V& v, const FloatBox& box) {
  return apart(v, box, k_axes[0]) || apart(v, box, k_axes[1]) || apart(v, box, k_axes[2]);
}
// Between the nearest points of the core and of the box, found by projecting to and fro.
bool overlaps(const Core& c, const FloatBox& box) {
  if (apart_on_axes(c, box)) return false;
  if (apart(c, box, cross(c.edge0, c.edge1))) return false;
  Float3 p = c.centre();
  for (int i = 0; i < 8; ++i) {
    const Float3 in_box = nearest_in(box, p);
    p = in_box - c.rest(in_box - c.origin);
    const Float3 n = in_box - p;
    if (dot(n, n) > k_tiny && apart(c, box, n / length_of(n))) return false;
  }
  return true;
}
bool overlaps(const BoundingSphere<float>& v, const FloatBox& box) {
  return overlaps(core_of(v), box);
}
bool overlaps(const Capsule<float>& v, const FloatBox& box) {
  return overlaps(core_of(v), box);
}
bool overlaps(const Lozenge<float>& v, const FloatBox& box) {
  return overlaps(core_of(v), box);
}
bool overlaps(const FloatBox& v, const FloatBox& box) {
  return v.min.x <= box.max.x && box.min.x <= v.max.x && v.min.y <= box.max.y && box.min.y <= v.max.y &&
         v.min.z <= box.max.z && box.min.z <= v.max.z;
}
bool overlaps(const OrientedBox<float>& v, const FloatBox& box) {
  if (apart_on_axes(v, box)) return false;
  for (const Float3& a : v.axes) {
    if (apart(v, box, a)) return false;
    for (const Float3& b : k_axes) {
      const Float3 n = cross(a, b);
      if (dot(n, n) > 1e-6f && apart(v, box, n)) return false;
    }
  }
  return true;
}
bool overlaps(const Ellipsoid<float>& v, const FloatBox& box) {
  if (apart_on_axes(v, box)) return false;
  const Float3 n = nearest_in(box, v.centre) - v.centre;
  if (dot(n, n) > k_tiny && apart(v, box, n / length_of(n))) return false;
  return !apart(v, box, v.axes[0]) && !apart(v, box, v.axes[1]) && !apart(v, box, v.axes[2]);
}
bool overlaps(const Cylinder<float>& v, const FloatBox& box) {
  const Float3 d = v.b - v.a;
  const float l = length_of(d);
  if (apart_on_axes(v, box) || (l > 0 && apart(v, box, d / l))) return false;
  const Core axis{v.a, d, {}, 0};
  const Float3 p = nearest_in(box, v.a + d * 0.5f), n = axis.rest(p - v.a);
  return !(dot(n, n) > k_tiny && apart(v, box, n / length_of(n)));
}
bool overlaps(const Kdop<float>& v, const FloatBox& box) {
  if (apart_on_axes(v, box)) return false;
  for (const Float3& n : v.normals) {
    if (apart(v, box, n)) return false;
  }
  return true;
}

bool near(const Core& c, const Float3& p, float radius) {
  const Float3 q = p - c.origin;
  return within(c.rest(q), c.radius + radius + c.room(q) + k_room * radius);
}
bool near(const BoundingSphere<float>& v, const Float3& p, float radius) {
  return near(core_of(v), p, radius);
}
bool near(const Capsule<float>& v, const Float3& p, float radius) {
  return near(core_of(v), p, radius);
}
bool near(const Lozenge<float>& v, const Float3& p, float radius) {
  return near(core_of(v), p, radius);
}
bool near(const FloatBox& v, const Float3& p, float radius) {
  const Float3 d = p - nearest_in(v, p);
  return within(d, radius * (1 + k_room) + k_room * sum_of(d));
}
bool near(const OrientedBox<float>& v, const Float3& p, float radius) {
  const Float3 d = p - v.centre;
  Float3 beyond;
  for (int i = 0; i < 3; ++i)
    beyond[i] = std::max(0.0f, std::abs(dot(v.axes[static_cast<std::size_t>(i)], d)) - v.half_extents[i]);
  return within(beyond, radius * (1 + k_room) + k_room * (sum_of(d) + sum_of(v.half_extents)));
}
bool near(const Cylinder<float>& v, const Float3& p, float radius) {
  const Float3 q = p - v.a, d = v.b - v.a;
  const float l = length_of(d), room = k_room * (sum_of(q) + sum_of(d) + v.radius + radius);
  const float t = l > 0 ? dot(q, d) / l : 0.0f;
  const float across = std::max(0.0f, length_of(q - (l > 0 ? d * (t / l) : Float3{})) - v.radius);
  const float ahead = std::max({0.0f, -t, t - l});
  return within({across, ahead, 0}, radius + 2 * room);
}
// Along the line of centres, then along the ellipsoid's normal there: either may separate them.
bool near(const Ellipsoid<float>& v, const Float3& p, float radius) {
  const Float3 d = p - v.centre;
  Float3 normal;
  for (int i = 0; i < 3; ++i) {
    const float a = std::max(v.semi_axes[i], k_room * sum_of(v.semi_axes));
    const Float3& axis = v.axes[static_cast<std::size_t>(i)];
    normal += axis * (dot(axis, d) / a * (sum_of(v.semi_axes) / a));
  }
  for (const Float3& n : {d, normal, v.axes[0], v.axes[1], v.axes[2]}) {
    const float l = length_of(n);
    if (!(l > 0) || !std::isfinite(l)) continue;
    const Float3 unit = n / l;
    const Interval i = along(v, unit);
    const float x = dot(unit, p), room = k_room * (size_along(unit, p) + radius);
    if (x - radius - room > i.high || x + radius + room < i.low) return false;
  }
  return true;
}
bool near(const Kdop<float>& v, const Float3& p, float radius) {
  for (std::size_t i = 0; i < v.normals.size(); ++i) {
    const Float3& n = v.normals[i];
    const float x = dot(n, p), r = radius * length_of(n), room = k_room * (size_along(n, p) + r);
    if (x - r - room > v.max[i] || x + r + room < v.min[i]) return false;
  }
  return true;
}

}  // namespace

bool contains(const Volume<float>& volume, const Float3& point) {
  return std::visit([&](const auto& v) { return holds(v, point); }, volume);
}

Visibility side_of(const Volume<float>& volume, const FloatPlane& plane) {
  const Interval i = std::visit([&](const auto& v) { return along(v, plane.normal); }, volume);
  const float room = k_room * std::abs(plane.offset);
  if (i.high + plane.offset < -room) return Visibility::outside;
  return i.low + plane.offset > room ? Visibility::inside : Visibility::crossing;
}

Visibility in_frustum(const Volume<float>& volume, std::span<const FloatPlane> planes, std::uint32_t& mask) {
  for (std::size_t p = 0; p < planes.size(); ++p) {
    if ((mask >> p & 1) == 0) continue;
    const Visibility side = side_of(volume, planes[p]);
    if (side == Visibility::outside) return side;
    if (side == Visibility::inside) mask &= ~(1u << p);
  }
  return mask == 0 ? Visibility::inside : Visibility::crossing;
}

bool meets_ray(const Volume<float>& volume, const FloatRay& ray) {
  return std::visit([&](const auto& v) { return hit(v, ray); }, volume);
}

bool meets_box(const Volume<float>& volume, const FloatBox& box) {
  return std::visit([&](const auto& v) { return overlaps(v, box); }, volume);
}

bool meets_ball(const Volume<float>& volume, const Float3& centre, float radius) {
  return std::visit([&](const auto& v) { return near(v, centre, radius); }, volume);
}

}  // namespace copse
