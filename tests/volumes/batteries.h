// Point sets that break fitters: the degenerate battery of the measured peers, with their truths where known.
#pragma once

#include "lib/formats/random.h"
#include "lib/formats/vec.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace copse {

struct BatterySet {
  std::string name;
  std::vector<Double3> points;
  int dimension = 3;
};

namespace battery {

using Points = std::vector<Double3>;

inline Points line(int n, const Double3& step) {
  Points p;
  for (int i = 0; i < n; ++i) p.push_back(step * i);
  return p;
}
inline Points grid(int nx, int ny, const Double3& u, const Double3& v) {
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
inline Points cube(const Double3& at = {}) {
  Points p;
  for (int i = 0; i < 8; ++i) p.push_back(at + Double3{double(i & 1), double(i >> 1 & 1), double(i >> 2)});
  return p;
}
inline Points cloud(int n, const Double3& half, std::uint64_t seed, const Double3& at = {}) {
  Random random(seed);
  Points p;
  for (int i = 0; i < n; ++i) {
    p.push_back(at + Double3{random.around(0, half.x), random.around(0, half.y), random.around(0, half.z)});
  }
  return p;
}
inline Points sphere(int n) {
  Points p;
  for (int i = 0; i < n; ++i) {  // a Fibonacci lattice
    const double z = 1 - (2 * i + 1.0) / n, r = std::sqrt(1 - z * z), a = i * 2.399963229728653;
    p.push_back({r * std::cos(a), r * std::sin(a), z});
  }
  return p;
}
inline Points torus(int m, int n, double big, double small) {
  Points p;
  for (int i = 0; i < m; ++i) {
    for (int j = 0; j < n; ++j) {
      const double a = 2 * std::numbers::pi * i / m, b = 2 * std::numbers::pi * j / n;
      const double r = big + small * std::cos(b);
      p.push_back({r * std::cos(a), r * std::sin(a), small * std::sin(b)});
    }
  }
  return p;
}
inline Points icosahedron() {
  Points p;
  const double phi = std::numbers::phi;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-phi, phi}) p.insert(p.end(), {{a, b, 0}, {0, a, b}, {b, 0, a}});
  }
  return p;
}
inline Points twig(double aspect) {
  Points p;
  for (int ring = 0; ring < 65; ++ring) {
    for (int i = 0; i < 12; ++i) {
      const double t = ring / 64.0, r = (1 - 0.7 * t) / aspect, a = 2 * std::numbers::pi * i / 12;
      p.push_back({r * std::cos(a), t, r * std::sin(a)});
    }
  }
  return p;
}
inline Points lattice(int n, std::uint64_t seed) {
  Random random(seed);
  Points p;
  for (int i = 0; i < n; ++i)
    p.push_back({double(random.below(3)), double(random.below(3)), double(random.below(3))});
  return p;
}
inline Points scaled(Points p, double by, const Double3& shift = {}) {
  for (Double3& q : p) q = q * by + shift;
  return p;
}
inline Points turned(Points p) {  // by some rotation with no special angle
  const Double3 u = normalized(Double3{2, -1, 3}), v = normalized(cross(u, {0, 1, 0})), w = cross(u, v);
  for (Double3& q : p) q = u * q.x + v * q.y + w * q.z;
  return p;
}

// Sizes and places that float32 can hold.
inline std::vector<BatterySet> all() {
  std::vector<BatterySet> b{
      {"one point", {{1, 2, 3}}, 0},
      {"one point, no float32", {{0.1, 0.2, 0.3}}, 0},
      {"100 equal", Points(100, {0.1, -5, 7}), 0},
      {"two points", {{0, 0, 0}, {1, 2, 3}}, 1},
      {"3 collinear", {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, 1},
      {"50 collinear", line(50, {0.1, 0.2, 0.3}), 1},
      {"along x", line(5, {1, 0, 0}), 1},
      {"planar grid", grid(10, 7, {1, 0, 0}, {0, 1, 0}), 2},
      {"tilted plane", turned(grid(10, 7, {1, 0, 0}, {0, 1, 0})), 2},
      {"circle 64", circle(64), 2},
      {"tilted circle", turned(circle(64)), 2},
      {"near planar", cloud(200, {1, 1, 1e-13}, 1)},
      {"needle 1e7", cloud(200, {1, 1e-7, 1e-7}, 2)},
      {"tilted needle 1e7", turned(cloud(200, {1, 1e-7, 1e-7}, 2))},
      {"needle 1e12", cloud(200, {1, 1e-12, 1e-12}, 3)},
      {"plate 1e6", turned(cloud(200, {1, 1, 1e-6}, 4))},
      {"cube", cube()},
      {"cube at 1e8", cube({1e8, 1e8, 1e8})},
      {"cloud at 1e7", cloud(300, {1, 2, 3}, 5, {1e7, -1e7, 3e6})},
      {"cloud at 1e9", cloud(300, {1, 2, 3}, 5, {1e9, 1e9, 1e9})},
      {"1e-30", scaled(cloud(100, {1, 2, 3}, 6), 1e-30)},
      {"1e30", scaled(cloud(100, {1, 2, 3}, 6), 1e30)},
      {"1e-160", scaled(cloud(50, {1, 2, 3}, 7), 1e-160)},
      {"1000 cospherical", sphere(1000)},
      {"torus", torus(40, 32, 0.5, 0.125)},
      {"icosahedron", icosahedron()},
      {"corner tetrahedron", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
      {"twig 10", twig(10)},
      {"twig 1e4", twig(1e4)},
      {"tilted twig 100", turned(twig(100))},
      {"one far point",
       [] {
         Points p = cloud(100, {1, 1, 1}, 8);
         p.push_back({1e6, 0, 0});
         return p;
       }()},
  };
  for (int i = 0; i < 20; ++i) b.push_back({"lattice " + std::to_string(i), lattice(4 + i % 6, 100 + i)});
  return b;
}

}  // namespace battery
}  // namespace copse
