// The quadric error of a vertex, in single precision over a unit box: planes and gradients of attributes.
#pragma once

#include "lib/formats/vec.h"

#include <array>

namespace copse {

inline constexpr std::size_t k_attributes = 5;  // normal and texture coordinate

// sum w (n . p + d)^2
struct PlaneQuadric {
  float xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0, x = 0, y = 0, z = 0, c = 0, weight = 0;

  void add_plane(const Float3& n, float d, float w) {
    xx += w * n.x * n.x, yy += w * n.y * n.y, zz += w * n.z * n.z;
    xy += w * n.x * n.y, xz += w * n.x * n.z, yz += w * n.y * n.z;
    x += w * n.x * d, y += w * n.y * d, z += w * n.z * d;
    c += w * d * d, weight += w;
  }
  PlaneQuadric& operator+=(const PlaneQuadric& b) {
    xx += b.xx, yy += b.yy, zz += b.zz, xy += b.xy, xz += b.xz, yz += b.yz;
    x += b.x, y += b.y, z += b.z, c += b.c, weight += b.weight;
    return *this;
  }
  float at(const Float3& p) const {
    const float value = p.x * (xx * p.x + 2 * (xy * p.y + xz * p.z + x)) +
                        p.y * (yy * p.y + 2 * (yz * p.z + y)) + p.z * (zz * p.z + 2 * z) + c;
    return value > 0 ? value : -value;
  }
};

// sum w (g . p + d - a)^2 over the attributes a, split into what depends on a and what does not.
struct AttributeQuadric {
  PlaneQuadric planes;
  std::array<std::array<float, 4>, k_attributes> gradient{};
  float weight = 0;

  AttributeQuadric& operator+=(const AttributeQuadric& b) {
    planes += b.planes;
    for (std::size_t k = 0; k < k_attributes; ++k)
      for (std::size_t i = 0; i < 4; ++i) gradient[k][i] += b.gradient[k][i];
    weight += b.weight;
    return *this;
  }
  float at(const Float3& p, const std::array<float, k_attributes>& a) const {
    float value = p.x * (planes.xx * p.x + 2 * (planes.xy * p.y + planes.xz * p.z + planes.x)) +
                  p.y * (planes.yy * p.y + 2 * (planes.yz * p.z + planes.y)) +
                  p.z * (planes.zz * p.z + 2 * planes.z) + planes.c;
    for (std::size_t k = 0; k < k_attributes; ++k) {
      const auto& g = gradient[k];
      value += a[k] * (a[k] * weight - 2 * (g[0] * p.x + g[1] * p.y + g[2] * p.z + g[3]));
    }
    return value > 0 ? value : 0;
  }
  void add_gradient(std::size_t k, const Float3& g, float d, float w) {
    planes.add_plane(g, d, w);
    planes.weight -= w;
    gradient[k][0] += w * g.x, gradient[k][1] += w * g.y, gradient[k][2] += w * g.z, gradient[k][3] += w * d;
  }
};

}  // namespace copse
