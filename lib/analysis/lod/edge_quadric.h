// The quadric error of a vertex, in single precision over a unit box: planes and gradients of attributes.
#pragma once

#include "lib/formats/vec.h"

#include <array>
#include <cstring>

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
  float signed_at(const Float3& p) const {
    return p.x * (xx * p.x + 2 * (xy * p.y + xz * p.z + x)) + p.y * (yy * p.y + 2 * (yz * p.z + y)) +
           p.z * (zz * p.z + 2 * z) + c;
  }
  float at(const Float3& p) const {
    const float value = signed_at(p);
    return value > 0 ? value : -value;
  }
};

// Four attributes at a time.
using Four [[gnu::vector_size(16)]] = float;

// sum w (g . p + d - a)^2 over the attributes a, split into what depends on a and what does not.
struct alignas(64) AttributeQuadric {
  PlaneQuadric planes;                                        // of the gradients; its weight is the sum of w
  std::array<std::array<float, k_attributes>, 4> gradient{};  // x, y, z and d of all attributes

  AttributeQuadric& operator+=(const AttributeQuadric& b) {
    planes += b.planes;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < k_attributes; ++k) gradient[i][k] += b.gradient[i][k];
    return *this;
  }
  float at(const Float3& p, const std::array<float, k_attributes>& a) const {
    float value = planes.signed_at(p);
    const Four four = four_of(a);
    const Four parts =
        four * (four * planes.weight - 2 * (four_of(gradient[0]) * p.x + four_of(gradient[1]) * p.y +
                                            four_of(gradient[2]) * p.z + four_of(gradient[3])));
    for (int k = 0; k < 4; ++k) value += parts[k];
    value += a[4] * (a[4] * planes.weight - 2 * (gradient[0][4] * p.x + gradient[1][4] * p.y +
                                                 gradient[2][4] * p.z + gradient[3][4]));
    return value > 0 ? value : 0;
  }
  // Of one face whose weight is w: of each attribute a gradient, and what it is at the origin.
  void set(const std::array<std::array<float, k_attributes>, 4>& g, float w) {
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < k_attributes; ++k) gradient[i][k] = w * g[i][k];
    const auto sum = [&](std::size_t i, std::size_t j) {
      const Four products = four_of(gradient[i]) * four_of(g[j]);
      return products[0] + products[1] + products[2] + products[3] + gradient[i][4] * g[j][4];
    };
    planes = {.xx = sum(0, 0),
              .yy = sum(1, 1),
              .zz = sum(2, 2),
              .xy = sum(0, 1),
              .xz = sum(0, 2),
              .yz = sum(1, 2),
              .x = sum(0, 3),
              .y = sum(1, 3),
              .z = sum(2, 3),
              .c = sum(3, 3),
              .weight = w};
  }

 private:
  static Four four_of(const std::array<float, k_attributes>& a) {
    Four out;
    std::memcpy(&out, a.data(), sizeof out);
    return out;
  }
};

}  // namespace copse
