// Models that obey the rules of the thesis, to be broken one rule at a time.
#pragma once

#include "lib/analysis/surface/weld.h"
#include "lib/analysis/trunk/strict_model.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace copse {

// A model that obeys every rule: a trunk of rings joined by bands, one leaf.
struct StrictModelMesh {
  Mesh mesh;
  std::vector<std::uint32_t> leaf_of;

  StrictModelMesh() {
    mesh.parts = {{"", "", 0}};
    mesh.materials.resize(1);
    mesh.materials[0].texture = 0;
    mesh.textures.resize(1);
    mesh.texcoords = {{0, 0}};
  }
  std::uint32_t ring(const Double3& centre, double radius, int k) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int i = 0; i < k; ++i) {
      const double a = 2 * std::numbers::pi * i / k;
      mesh.positions.push_back(centre + Double3{radius * std::cos(a), 0, radius * std::sin(a)});
    }
    return first;
  }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t leaf = k_none) {
    mesh.triangles.push_back({a, b, c});
    mesh.texcoord_triangles.push_back({0, 0, 0});
    mesh.part_of.push_back(0);
    leaf_of.push_back(leaf);
  }
  void band(std::uint32_t a, std::uint32_t b, std::uint32_t k) {
    for (std::uint32_t i = 0; i < k; ++i) {
      const std::uint32_t j = (i + 1) % k;
      triangle(a + i, b + i, a + j), triangle(a + j, b + i, b + j);
    }
  }
  void leaf(double x) {
    const auto v = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Double3& d : {Double3{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})
      mesh.positions.push_back(d + Double3{x, 9, 0});
    triangle(v, v + 1, v + 2, 0);
  }
  std::vector<std::uint32_t> welded() const { return weld(mesh.positions, 1e-9); }
  StrictModel read() const { return read_strict_model(mesh, welded(), leaf_of); }
};

// A trunk alone, so long that what recurses along it overflows: segments, one above the other.
inline StrictModelMesh vine_model(int segments) {
  StrictModelMesh m;
  std::uint32_t last = m.ring({0, -1, 0}, 1, 3);
  for (int i = 0; i < segments; ++i) {
    const auto next = m.ring({0, double(i), 0}, 1, 3);
    m.band(last, next, 3);
    last = next;
  }
  return m;
}

inline StrictModelMesh sound_model(int k = 5) {
  StrictModelMesh m;
  const auto n = static_cast<std::uint32_t>(k);
  const auto root = m.ring({0, -1, 0}, 1, k), middle = m.ring({0, 2, 0}, 0.9, k),
             top = m.ring({0, 5, 0}, 0.5, k), side = m.ring({3, 3, 0}, 0.4, k);
  m.band(root, middle, n), m.band(middle, top, n), m.band(middle, side, n);
  m.leaf(20);
  return m;
}

}  // namespace copse
