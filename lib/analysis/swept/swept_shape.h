// Capsules and lozenges in a frame of their own: a rectangle [a0, a1] x [b0, b1] at height h, within r of
// which the points lie. A capsule is one with b0 = b1; a line, one with b0 = b1 whose ends do not matter.
#pragma once

#include "lib/analysis/hull/frame.h"
#include "lib/formats/vec.h"

#include <cmath>
#include <numbers>

namespace copse {

// Axes are used as a rotation: axis k is row k. Axis 0 is along a, 1 along b, 2 across.
inline Double3 into(const Axes& frame, const Double3& p) {
  return {dot(frame[0], p), dot(frame[1], p), dot(frame[2], p)};
}
inline Double3 out_of(const Axes& frame, const Double3& q) {
  return frame[0] * q.x + frame[1] * q.y + frame[2] * q.z;
}

enum class Swept { line, capsule, lozenge };

struct SweptLengths {  // all that the volume depends on
  double a = 0, b = 0, r = 0;
};

// 2 r a b + pi r^2 (a + b) + 4/3 pi r^3. Its cube root is concave (Brunn-Minkowski: with one frame, a mean of
// lengths is the Minkowski mean of the bodies), so over a polytope of lengths it is least at a vertex.
constexpr double swept_volume(const SweptLengths& l) {
  return l.r * (2 * l.a * l.b + std::numbers::pi * l.r * (l.a + l.b + 4.0 / 3.0 * l.r));
}

struct SweptRectangle {
  double a0 = 0, a1 = 0, b0 = 0, b1 = 0, h = 0, r = 0;
  SweptLengths lengths() const { return {a1 - a0, b1 - b0, r}; }
};

// From the rectangle to q, which is in its frame.
inline Double3 offset_from(const SweptRectangle& s, const Double3& q) {
  return {q.x < s.a0   ? q.x - s.a0
          : q.x > s.a1 ? q.x - s.a1
                       : 0,
          q.y < s.b0   ? q.y - s.b0
          : q.y > s.b1 ? q.y - s.b1
                       : 0,
          q.z - s.h};
}

// `frame` turned by the rotation whose Cayley vector (axis times the tangent of half the angle, in local
// coordinates) is g: p -> R(g) frame p.
inline Axes turned(const Axes& frame, const Double3& g) {
  const double n = 1 / (1 + dot(g, g));
  // Rows of R(g) = ((1 - g.g) I + 2 g g^T + 2 [g]x) / (1 + g.g)
  const double d = (1 - dot(g, g)) * n;
  const auto row = [&](int k) {
    Double3 unit;
    unit[k] = 1;
    return unit * d + g * (2 * g[k] * n) - cross(g, unit) * (2 * n);
  };
  return {out_of(frame, row(0)), out_of(frame, row(1)), out_of(frame, row(2))};
}

// Rows made orthonormal again, the first kept in direction.
inline Axes orthonormal(const Axes& f) {
  const Double3 u = normalized(f[0]);
  const Double3 v = normalized(f[1] - u * dot(u, f[1]));
  return {u, v, cross(u, v)};
}

}  // namespace copse
