// patch: a set of leaf triangles as its moments: how much, where, how spread, which way it faces.
//
// Moments add up, so what two merged sets look like is known exactly, from their leaves, at every level:
// errors of one collapse do not go into the next.
#pragma once

#include "lib/formats/vec.h"

#include <array>

namespace copse {

// xx, yy, zz, xy, xz, yz
struct Symmetric3 {
  std::array<double, 6> m{};
  Symmetric3& operator+=(const Symmetric3& b) {
    for (int i = 0; i < 6; ++i) m[i] += b.m[i];
    return *this;
  }
  void add(const Double3& v, double weight);  // weight v v^T
  double along(const Double3& v) const;       // v^T M v
  double trace() const { return m[0] + m[1] + m[2]; }
};

struct Eigen3 {
  std::array<double, 3> values;    // descending
  std::array<Double3, 3> vectors;  // unit, right-handed; signs by a fixed rule
};
Eigen3 eigen(const Symmetric3& m);

struct Patch {
  double area = 0;     // of all triangles
  double opaque = 0;   // the part that the alpha test lets through
  double visible = 0;  // opaque area times the share of directions that see it (crown_field.h)
  double open = 0;     // area times openness: ground that nothing else covers (crown_field.h)
  Double3 first{};     // sum of area x position
  Symmetric3 second;   // sum of area x position position^T
  Symmetric3 facing;   // sum of area x normal normal^T
  Double3 shading{};   // sum of area x shading normal
  Double3 up{};        // sum of area x the direction in which the texture's v grows

  Patch& operator+=(const Patch& b);
  Double3 centre() const { return area > 0 ? first / area : first; }
  Symmetric3 covariance() const;  // of position, by area; not below 0 on its diagonal
};

// The triangle's exact moments; positions should be near the origin, so that nothing cancels.
Patch patch_of(const std::array<Double3, 3>& corners, double opacity, double exposure);

}  // namespace copse
