// The degenerate battery: what breaks fitters, with its truths where they are known (anchors, section 9).
#pragma once

#include "lib/formats/random.h"
#include "lib/formats/vec.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace copse::awkward {  // other tests of this program have sets of the same names

struct NamedPoints {
  std::string name;
  std::vector<Double3> points;
};

inline std::vector<Double3> cube_corners(double size = 1, const Double3& at = {}) {
  std::vector<Double3> p;
  for (int i = 0; i < 8; ++i) {
    p.push_back(at + Double3{i & 1 ? size : 0., i & 2 ? size : 0., i & 4 ? size : 0.});
  }
  return p;
}

inline std::vector<Double3> random_cloud(std::uint64_t seed, int n, const Double3& size,
                                         const Double3& at = {}) {
  Random random(seed);
  std::vector<Double3> p;
  for (int i = 0; i < n; ++i) {
    p.push_back(at + Double3{size.x * random.uniform(-1, 1), size.y * random.uniform(-1, 1),
                             size.z * random.uniform(-1, 1)});
  }
  return p;
}

inline std::vector<Double3> on_sphere(std::uint64_t seed, int n) {
  Random random(seed);
  std::vector<Double3> p;
  while (static_cast<int>(p.size()) < n) {
    const Double3 v{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    if (dot(v, v) <= 1 && dot(v, v) > 1e-3) p.push_back(v / length(v));
  }
  return p;
}

// rows rings of n points: radius about a circle of radius ring in the plane z = 0.
inline std::vector<Double3> torus(int n, int rows, double ring, double radius) {
  std::vector<Double3> p;
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < rows; ++k) {
      const double a = 2 * std::numbers::pi * i / n, b = 2 * std::numbers::pi * k / rows;
      const double r = ring + radius * std::cos(b);
      p.push_back({r * std::cos(a), r * std::sin(a), radius * std::sin(b)});
    }
  }
  return p;
}

// 65 rings of 12: length 1, radius 1 / aspect falling to 0.3 / aspect.
inline std::vector<Double3> twig(double aspect) {
  std::vector<Double3> p;
  for (int i = 0; i < 65; ++i) {
    for (int k = 0; k < 12; ++k) {
      const double t = i / 64., a = 2 * std::numbers::pi * k / 12, r = (1 - 0.7 * t) / aspect;
      p.push_back({r * std::cos(a), r * std::sin(a), t});
    }
  }
  return p;
}

inline std::vector<Double3> icosahedron() {
  const double phi = std::numbers::phi;
  std::vector<Double3> p;
  for (const double s : {-1., 1.}) {
    for (const double t : {-phi, phi})
      p.insert(p.end(), {Double3{s, t, 0}, Double3{0, s, t}, Double3{t, 0, s}});
  }
  return p;
}

inline std::vector<Double3> turned(std::vector<Double3> points, const Double3& u, const Double3& toward) {
  const Double3 a = normalized(u), c = normalized(cross(a, toward)), b = cross(c, a);
  for (Double3& p : points) p = a * p.x + b * p.y + c * p.z;
  return points;
}

inline std::vector<NamedPoints> degenerate_battery() {
  std::vector<NamedPoints> sets;
  const auto add = [&](std::string name, std::vector<Double3> p) {
    sets.push_back({std::move(name), std::move(p)});
  };
  add("one point", {{3, -4, 5}});
  add("one point far away", {{1e9, -4e9, 5e9}});
  add("two points", {{0, 0, 0}, {1, 2, 3}});
  add("three collinear", {{0, 0, 0}, {1, 2, 3}, {2, 4, 6}});
  add("three equal", std::vector<Double3>(3, {0.1, 0.2, 0.3}));
  add("100 equal", std::vector<Double3>(100, {-7, 1e-3, 1e3}));
  std::vector<Double3> line, grid, circle, plate;
  for (int i = 0; i < 50; ++i) line.push_back(Double3{0.1, 0.2, 0.3} * double(i));
  for (int i = 0; i < 70; ++i) grid.push_back({double(i % 10), double(i / 10), 0});
  for (int i = 0; i < 64; ++i) {
    circle.push_back({std::cos(i * std::numbers::pi / 32), std::sin(i * std::numbers::pi / 32), 0});
  }
  for (int i = 0; i < 100; ++i) plate.push_back({double(i % 10), double(i / 10), 1e-13 * (i % 3)});
  add("50 collinear", line);
  add("planar grid", grid);
  add("tilted plane", turned(grid, {1, 2, 3}, {-3, 1, 2}));
  add("circle", circle);
  add("nearly planar", plate);
  add("triangle", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  add("corner tetrahedron", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  for (const double aspect : {1e3, 1e7, 1e12}) {
    add("needle", random_cloud(1, 300, {1, 1 / aspect, 1 / aspect}));
    add("tilted needle", turned(random_cloud(1, 300, {1, 1 / aspect, 1 / aspect}), {1, 2, 3}, {-3, 1, 2}));
    add("plate", random_cloud(2, 300, {1, 1, 1 / aspect}));
  }
  add("cube", cube_corners());
  add("cube at 1e8", cube_corners(1, {1e8, 1e8, -1e8}));
  add("cloud at 1e9", random_cloud(3, 500, {1, 2, 1.5}, {1e9, -1e9, 1e9}));
  for (const double scale : {1e-160, 1e-30, 1e30, 1e200})
    add("scaled", random_cloud(4, 200, {scale, scale / 2, scale}));
  add("cospherical", on_sphere(5, 1000));
  add("torus", torus(40, 32, 0.5, 0.125));
  add("twig 10", twig(10));
  add("twig 10000", twig(10000));
  add("icosahedron", icosahedron());
  Random random(6);
  for (int i = 0; i < 20; ++i) {
    std::vector<Double3> p;
    for (int k = 0; k < 7; ++k)
      p.push_back({double(random.below(3)), double(random.below(3)), double(random.below(3))});
    add("lattice", p);
  }
  return sets;
}

}  // namespace copse::awkward

namespace copse {
using namespace awkward;
}  // namespace copse
