// Point sets with known volumes around them, for the tests of capsules and lozenges.
#pragma once

#include "lib/formats/random.h"
#include "lib/formats/vec.h"

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

inline Points unit_cube() {
  Points p;
  for (int i = 0; i < 8; ++i) p.push_back({double(i & 1), double(i >> 1 & 1), double(i >> 2)});
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

// 40 x 32 points, radii 0.5 and 0.125, about the y axis.
inline Points torus() {
  Points p;
  for (int i = 0; i < 40; ++i) {
    for (int j = 0; j < 32; ++j) {
      const double a = 2 * std::numbers::pi * i / 40, b = 2 * std::numbers::pi * j / 32;
      const double r = 0.5 + 0.125 * std::cos(b);
      p.push_back({r * std::cos(a), 0.125 * std::sin(b), r * std::sin(a)});
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

// Clouds of all sorts for properties that must always hold.
inline std::vector<NamedPoints> mixed_sets() {
  Random random(11);
  std::vector<NamedPoints> sets{{"cube", unit_cube()},
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
  Points grid;
  for (int i = 0; i < 27; ++i) grid.push_back({i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0});
  sets.push_back({"grid", grid});
  return sets;
}

// Sets of dimension 0, 1 and 2.
inline std::vector<NamedPoints> flat_sets() {
  std::vector<NamedPoints> sets{{"one point", {{0.3, -0.4, 0.5}}},
                                {"equal points", Points(100, Double3{0.3, -0.4, 0.5})},
                                {"two points", {{0, 0, 0}, {0.25, 0.5, 0.75}}}};
  Points line, grid, circle;
  for (int i = 0; i < 50; ++i) line.push_back(Double3{0.1, 0.2, 0.3} * (i / 50.0));
  for (int i = 0; i < 70; ++i) grid.push_back({i % 10 / 10.0, 0, i / 10 / 10.0});
  for (int i = 0; i < 64; ++i) {
    const double a = 2 * std::numbers::pi * i / 64;
    circle.push_back({std::cos(a), std::sin(a), 0});
  }
  sets.push_back({"collinear", line});
  sets.push_back({"planar grid", grid});
  sets.push_back({"circle", circle});
  return sets;
}

}  // namespace copse
