// Meshes for the tests of edge collapses.
#pragma once

#include "lib/formats/levels/part_triangles.h"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace copse {

// A grid of n x n squares over [0, 1]^2, its heights given; texture coordinates as the place.
template <class Height>
PartTriangles grid(std::uint32_t n, Height height) {
  PartTriangles mesh;
  for (std::uint32_t y = 0; y <= n; ++y) {
    for (std::uint32_t x = 0; x <= n; ++x) {
      const double u = static_cast<double>(x) / n, v = static_cast<double>(y) / n;
      mesh.vertices.push_back(
          {to_float({u, height(u, v), v}), {0, 1, 0}, {static_cast<float>(u), static_cast<float>(v)}});
      mesh.position_of.push_back(y * (n + 1) + x);
    }
  }
  for (std::uint32_t y = 0; y < n; ++y) {
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t a = y * (n + 1) + x, b = a + 1, c = a + n + 1, d = c + 1;
      mesh.triangles.push_back({a, c, b}), mesh.triangles.push_back({b, c, d});
    }
  }
  mesh.materials.assign(mesh.triangles.size(), 0);
  return mesh;
}

// A closed torus; with `seam` the texture wraps along one circle, whose vertices are there twice.
inline PartTriangles torus(std::uint32_t n, std::uint32_t m, bool seam) {
  PartTriangles mesh;
  const auto add = [&](std::uint32_t i, std::uint32_t j, float u) {
    const double a = 2 * std::numbers::pi * i / n, b = 2 * std::numbers::pi * j / m;
    const Double3 out{std::cos(a) * std::cos(b), std::sin(b), std::sin(a) * std::cos(b)};
    mesh.vertices.push_back(
        {to_float(Double3{std::cos(a), 0, std::sin(a)} * 2.0 + out * 0.7), to_float(out), {u, 0.5f}});
    mesh.position_of.push_back(i % n * m + j);
  };
  const std::uint32_t rows = seam ? n + 1 : n;
  for (std::uint32_t i = 0; i < rows; ++i)
    for (std::uint32_t j = 0; j < m; ++j) add(i, j, seam ? static_cast<float>(i) / static_cast<float>(n) : 0);
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < m; ++j) {
      const std::uint32_t a = i * m + j, b = i * m + (j + 1) % m, k = (i + 1) % rows, c = k * m + j,
                          d = k * m + (j + 1) % m;
      mesh.triangles.push_back({a, b, c}), mesh.triangles.push_back({b, d, c});
    }
  }
  mesh.materials.assign(mesh.triangles.size(), 0);
  return mesh;
}

}  // namespace copse
