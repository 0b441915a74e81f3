// Bounding volumes as they are stored (T = float) and fitted (T = double), and what "inside" means for each.
//
// The inequality beside a type is the contract: what lib/runtime evaluates, what fitters must satisfy, and
// what a certificate proves in exact arithmetic for the numbers as stored. It takes the numbers as they are:
// axes are unit and orthogonal up to their rounding, and nothing is normalised before the test.
//
// Source: digest 002, sections 3 and 4.
#pragma once

#include "lib/formats/vec.h"

#include <array>
#include <variant>
#include <vector>

namespace copse {

// An axis-aligned box is a Box<T>: min <= p <= max.

// |p - centre|^2 <= radius^2
template <class T>
struct BoundingSphere {
  Vec3<T> centre;
  T radius{};
  friend bool operator==(const BoundingSphere&, const BoundingSphere&) = default;
};

// |axes[i] . (p - centre)| <= half_extents[i]
template <class T>
struct OrientedBox {
  Vec3<T> centre;
  std::array<Vec3<T>, 3> axes;
  Vec3<T> half_extents;
  friend bool operator==(const OrientedBox&, const OrientedBox&) = default;
};

// With d = b - a and s = (p - a) . d / d . d clamped to [0, 1] (0 when d = 0): |p - a - s d|^2 <= radius^2
template <class T>
struct Capsule {
  Vec3<T> a, b;
  T radius{};
  friend bool operator==(const Capsule&, const Capsule&) = default;
};

// With d = b - a, d != 0: 0 <= (p - a) . d <= d . d and |(p - a) x d|^2 <= radius^2 d . d
template <class T>
struct Cylinder {
  Vec3<T> a, b;
  T radius{};
  friend bool operator==(const Cylinder&, const Cylinder&) = default;
};

// A rectangle with a radius (rectangle swept sphere). With s and t as for the capsule, along edge0 and along
// edge1: |p - origin - s edge0 - t edge1|^2 <= radius^2
template <class T>
struct Lozenge {
  Vec3<T> origin, edge0, edge1;
  T radius{};
  friend bool operator==(const Lozenge&, const Lozenge&) = default;
};

// sum over i of (axes[i] . (p - centre) / semi_axes[i])^2 <= 1; where a semi-axis is 0, that component is 0
template <class T>
struct Ellipsoid {
  Vec3<T> centre;
  std::array<Vec3<T>, 3> axes;
  Vec3<T> semi_axes;
  friend bool operator==(const Ellipsoid&, const Ellipsoid&) = default;
};

// min[i] <= normals[i] . p <= max[i]; k/2 normals of any length but 0
template <class T>
struct Kdop {
  std::vector<Vec3<T>> normals;
  std::vector<T> min, max;
  friend bool operator==(const Kdop&, const Kdop&) = default;
};

template <class T>
using Volume = std::variant<Box<T>, BoundingSphere<T>, OrientedBox<T>, Capsule<T>, Cylinder<T>, Lozenge<T>,
                            Ellipsoid<T>, Kdop<T>>;

}  // namespace copse
