// Point sets for the tests of volumes: makers, sets with known volumes round them, and the degenerate battery
// that breaks fitters (anchors, section 9).
#pragma once

#include "lib/formats/random.h"
#include "lib/formats/vec.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace copse {

using Points = std::vector<Double3>;

struct NamedPoints {
  std::string name;
  Points points;
};

// --- makers

template <class Make>
Points repeated(std::size_t n, Make&& make) {
  Points points;
  for (std::size_t i = 0; i < n; ++i) points.push_back(make());
  return points;
}

inline Double3 in_box(Random& random, const Double3& half) {
  return {random.around(0, half.x), random.around(0, half.y), random.around(0, half.z)};
}

inline Double3 on_unit_sphere(Random& random) {
  const double z = random.around(0, 1), a = random.uniform(0, 2 * std::numbers::pi);
  const double r = std::sqrt(std::max(0.0, 1 - z * z));
  return {r * std::cos(a), r * std::sin(a), z};
}

inline Points random_cloud(std::uint64_t seed, int n, const Double3& half, const Double3& at = {}) {
  Random random(seed);
  return repeated(static_cast<std::size_t>(n), [&] { return at + in_box(random, half); });
}

inline Points on_sphere(std::uint64_t seed, int n) {
  Random random(seed);
  return repeated(static_cast<std::size_t>(n), [&] { return on_unit_sphere(random); });
}

inline Points even_sphere(int n) {  // a Fibonacci lattice
  Points p;
  for (int i = 0; i < n; ++i) {
    const double z = 1 - (2 * i + 1.0) / n, r = std::sqrt(1 - z * z), a = i * 2.399963229728653;
    p.push_back({r * std::cos(a), r * std::sin(a), z});
  }
  return p;
}

inline Points line(int n, const Double3& step) {
  Points p;
  for (int i = 0; i < n; ++i) p.push_back(step * i);
  return p;
}

inline Points grid(int nx, int ny, const Double3& u = {1, 0, 0}, const Double3& v = {0, 1, 0}) {
  Points p;
  for (int i = 0; i < nx; ++i) {
    for (int j = 0; j < ny; ++j) p.push_back(u * i + v * j);
  }
  return p;
}

inline Points circle(int n) {
  Points p;
  for (int i = 0; i < n; ++i) {
    const double a = 2 * std::numbers::pi * i / n;
    p.push_back({std::cos(a), std::sin(a), 0});
  }
  return p;
}

inline Points cube_corners(double size = 1, const Double3& at = {}) {
  Points p;
  for (int i = 0; i < 8; ++i)
    p.push_back(at + Double3{i & 1 ? size : 0., i & 2 ? size : 0., i & 4 ? size : 0.});
  return p;
}

inline Points corner_tetrahedron() {
  return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
}

inline Points icosahedron() {
  Points p;
  for (const double s : {-1.0, 1.0}) {
    for (const double t : {-1.0, 1.0}) {
      const double phi = t * std::numbers::phi;
      p.push_back({s, phi, 0}), p.push_back({0, s, phi}), p.push_back({phi, 0, s});
    }
  }
  return p;
}

// rows rings of n points about the y axis.
inline Points torus(int n = 40, int rows = 32, double ring = 0.5, double radius = 0.125) {
  Points p;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < rows; ++j) {
      const double a = 2 * std::numbers::pi * i / n, b = 2 * std::numbers::pi * j / rows;
      const double r = ring + radius * std::cos(b);
      p.push_back({r * std::cos(a), radius * std::sin(b), r * std::sin(a)});
    }
  }
  return p;
}

// 65 rings of 12 points, length 1, radius 1 / aspect at the foot and 0.3 of that at the top.
inline Points twig(double aspect) {
  Points p;
  for (int i = 0; i <= 64; ++i) {
    const double t = i / 64.0, r = (1 - 0.7 * t) / aspect;
    for (int j = 0; j < 12; ++j) {
      const double a = 2 * std::numbers::pi * j / 12;
      p.push_back({r * std::cos(a), t, r * std::sin(a)});
    }
  }
  return p;
}

// Points of a grid of three a side, some of them equal, many of them in one plane.
inline Points lattice(int n, std::uint64_t seed) {
  Random random(seed);
  return repeated(static_cast<std::size_t>(n), [&] {
    const auto c = [&] { return static_cast<double>(random.below(3)); };
    const double x = c(), y = c(), z = c();
    return Double3{x, y, z};
  });
}

// Points on the surface of a capsule along (1, 2, 3), length 1, radius 0.2; both half spheres are held.
inline Points capsule_samples() {
  Random random(7);
  const Double3 w = normalized({1, 2, 3}), u = normalized(cross(w, {1, 0, 0})), v = cross(w, u);
  return repeated(600, [&] {
    const Double3 s = on_unit_sphere(random);
    const Double3 q = (u * s.x + v * s.y + w * s.z) * 0.2;
    return q + w * (s.z > 0 ? 0.5 : -0.5);
  });
}

inline Points scaled(Points points, double by, const Double3& shift = {}) {
  for (Double3& p : points) p = p * by + shift;
  return points;
}

inline Points turned(Points points, const Double3& u, const Double3& toward) {
  const Double3 a = normalized(u), c = normalized(cross(a, toward)), b = cross(c, a);
  for (Double3& p : points) p = a * p.x + b * p.y + c * p.z;
  return points;
}
inline Points turned(Points points) {  // by some rotation with no special angle
  return turned(std::move(points), {2, -1, 3}, {0, 1, 0});
}

// --- sets

// Clouds of all sorts for properties that must always hold.
inline std::vector<NamedPoints> mixed_sets() {
  Random random(11);
  std::vector<NamedPoints> sets{{"cube", cube_corners()},
                                {"corner tetrahedron", corner_tetrahedron()},
                                {"icosahedron", icosahedron()},
                                {"torus", torus()},
                                {"twig", twig(10)},
                                {"capsule samples", capsule_samples()}};
  const auto cloud = [&](const char* name, std::size_t n, const Double3& half) {
    sets.push_back({name, repeated(n, [&] { return in_box(random, half); })});
  };
  cloud("box", 60, {1, 1, 1});
  cloud("brick", 40, {1, 0.5, 0.2});
  cloud("needle", 40, {1, 1e-3, 1e-3});
  cloud("plate", 40, {1, 1, 1e-4});
  cloud("blade", 40, {1, 1e-2, 1e-4});
  cloud("four points", 4, {1, 1, 1});
  sets.push_back({"cospherical", repeated(100, [&] { return on_unit_sphere(random); })});
  Points cubes;
  for (int i = 0; i < 27; ++i) cubes.push_back({i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0});
  sets.push_back({"grid", cubes});
  return sets;
}

// Sets of dimension 0, 1 and 2.
inline std::vector<NamedPoints> flat_sets() {
  return {{"one point", {{0.3, -0.4, 0.5}}},
          {"equal points", Points(100, Double3{0.3, -0.4, 0.5})},
          {"two points", {{0, 0, 0}, {0.25, 0.5, 0.75}}},
          {"collinear", line(50, Double3{0.1, 0.2, 0.3} / 50)},
          {"planar grid", grid(10, 7, {0.1, 0, 0}, {0, 0, 0.1})},
          {"circle", circle(64)}};
}

// What breaks fitters; some of it beyond float32.
inline std::vector<NamedPoints> degenerate_battery() {
  std::vector<NamedPoints> sets{{"one point", {{3, -4, 5}}},
                                {"one point, no float32", {{0.1, 0.2, 0.3}}},
                                {"one point at 4e9", {{1e9, -4e9, 5e9}}},
                                {"two points", {{0, 0, 0}, {1, 2, 3}}},
                                {"three collinear", {{0, 0, 0}, {1, 2, 3}, {2, 4, 6}}},
                                {"three equal", Points(3, {0.1, 0.2, 0.3})},
                                {"100 equal", Points(100, {0.1, -5, 7})},
                                {"50 collinear", line(50, {0.1, 0.2, 0.3})},
                                {"along x", line(5, {1, 0, 0})},
                                {"triangle", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                                {"planar grid", grid(10, 7)},
                                {"tilted plane", turned(grid(10, 7))},
                                {"circle", circle(64)},
                                {"tilted circle", turned(circle(64))},
                                {"cube", cube_corners()},
                                {"cube at 1e8", cube_corners(1, {1e8, 1e8, -1e8})},
                                {"corner tetrahedron", corner_tetrahedron()},
                                {"icosahedron", icosahedron()},
                                {"torus", torus()},
                                {"1000 cospherical", even_sphere(1000)},
                                {"1000 cospherical, random", on_sphere(5, 1000)},
                                {"twig 10", twig(10)},
                                {"tilted twig 100", turned(twig(100))},
                                {"twig 1e4", twig(1e4)},
                                {"near planar 1e-13", random_cloud(1, 200, {1, 1, 1e-13})},
                                {"cloud at 1e7", random_cloud(5, 300, {1, 2, 3}, {1e7, -1e7, 3e6})},
                                {"cloud at 1e9", random_cloud(3, 500, {1, 2, 1.5}, {1e9, -1e9, 1e9})}};
  const auto add = [&](const std::string& name, Points p) { sets.push_back({name, std::move(p)}); };
  for (const char* aspect : {"1e3", "1e7", "1e12"}) {
    const double thin = 1 / std::stod(aspect);
    add(std::string("needle ") + aspect, random_cloud(2, 200, {1, thin, thin}));
    add(std::string("tilted needle ") + aspect, turned(random_cloud(2, 200, {1, thin, thin})));
    add(std::string("plate ") + aspect, random_cloud(4, 200, {1, 1, thin}));
    add(std::string("tilted plate ") + aspect, turned(random_cloud(4, 200, {1, 1, thin})));
  }
  for (const char* scale : {"1e-160", "1e-30", "1e30", "1e200"})
    add(std::string("cloud of ") + scale, scaled(random_cloud(6, 100, {1, 2, 3}), std::stod(scale)));
  Points far = random_cloud(8, 100, {1, 1, 1});
  far.push_back({1e6, 0, 0});
  add("one far point", far);
  for (int i = 0; i < 20; ++i)
    add("lattice " + std::to_string(i), lattice(4 + i % 6, 100 + static_cast<std::uint64_t>(i)));
  return sets;
}

// Those that float32 can hold.
inline std::vector<NamedPoints> float32_battery() {
  std::vector<NamedPoints> sets = degenerate_battery();
  std::erase_if(sets, [](const NamedPoints& set) {
    return std::any_of(set.points.begin(), set.points.end(),
                       [](const Double3& p) { return length(p) > 1e38; });
  });
  return sets;
}

}  // namespace copse
