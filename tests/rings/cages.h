// Cages of skins made by hand.
#pragma once

#include "lib/analysis/surface/reverse_subdivision.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// A cage under construction.
struct Maker {
  Cage cage;

  Maker() {
    cage.levels = 1;
    cage.is_on_limit = true;
    cage.precision = 1e-12;
  }
  std::uint32_t vertex(const Double3& p) {
    cage.vertex.push_back(static_cast<std::uint32_t>(cage.positions.size()));
    cage.positions.push_back(p);
    return cage.vertex.back();
  }
  void face(std::span<const std::uint32_t> corners) {
    cage.face_of.push_back(static_cast<std::uint32_t>(cage.faces.count()));  // one triangle each will do
    cage.faces.items.insert(cage.faces.items.end(), corners.begin(), corners.end());
    cage.faces.first.push_back(static_cast<std::uint32_t>(cage.faces.items.size()));
  }
  using Ring = std::array<std::uint32_t, 4>;
  // A square of half side `radius` across `normal`.
  Ring ring(const Double3& centre, const Double3& normal, double radius) {
    const Double3 n = normalized(normal), u = normalized(cross(n, {0.01, 0.02, 1})), v = cross(n, u);
    return {vertex(centre + (u + v) * radius), vertex(centre + (v - u) * radius),
            vertex(centre - (u + v) * radius), vertex(centre + (u - v) * radius)};
  }
  void band(const Ring& a, const Ring& b) {
    for (std::size_t i = 0; i < 4; ++i) face(std::array{a[i], a[(i + 1) % 4], b[(i + 1) % 4], b[i]});
  }
};

// Rings along a polyline: `between` in each straight piece, mitred at its corners.
inline std::vector<Maker::Ring> limb(Maker& m, std::span<const Double3> corners,
                                     std::span<const double> radii, int between) {
  std::vector<Maker::Ring> rings;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Double3 in = i > 0 ? normalized(corners[i] - corners[i - 1]) : normalized(corners[1] - corners[0]);
    const Double3 out = i + 1 < corners.size() ? normalized(corners[i + 1] - corners[i]) : in;
    rings.push_back(m.ring(corners[i], in + out, radii[i]));
    if (i + 1 == corners.size()) break;
    for (int b = 1; b <= between; ++b) {
      const double t = b / (between + 1.0);
      rings.push_back(
          m.ring(corners[i] * (1 - t) + corners[i + 1] * t, out, radii[i] * (1 - t) + radii[i + 1] * t));
    }
  }
  for (std::size_t i = 1; i < rings.size(); ++i) m.band(rings[i - 1], rings[i]);
  return rings;
}

// Three limbs of two rings and more on the faces of a cube, whose other faces are the hull.
struct Fork {
  Maker m;
  Double3 middle{5, 2, -3};

  explicit Fork(double moved = 0) {
    std::array<std::uint32_t, 8> cube{};
    for (std::uint32_t i = 0; i < 8; ++i) {
      cube[i] = m.vertex(middle + Double3{i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0});
    }
    const std::array<Maker::Ring, 3> seats{{{cube[0], cube[1], cube[5], cube[4]},    // below
                                            {cube[2], cube[3], cube[7], cube[6]},    // above
                                            {cube[1], cube[3], cube[7], cube[5]}}};  // beside
    const std::array<Double3, 3> ways{{{0, -1, 0}, {0, 1, 0}, {1, 0, 0}}};
    for (std::size_t l = 0; l < 3; ++l) {
      Maker::Ring last = seats[l];
      for (int step = 1; step <= 3; ++step) {
        Maker::Ring next{};
        for (std::size_t i = 0; i < 4; ++i) next[i] = m.vertex(m.cage.positions[last[i]] + ways[l] * 2.0);
        m.band(last, next);
        last = next;
      }
      m.face(last);
    }
    m.face(std::array{cube[0], cube[2], cube[6], cube[4]});
    m.face(std::array{cube[0], cube[1], cube[3], cube[2]});
    m.face(std::array{cube[4], cube[5], cube[7], cube[6]});
    for (std::size_t i = 0; i < 8; ++i)
      m.cage.positions[cube[i]] += Double3{0.1, 0.2, -0.1} * (moved * static_cast<double>(i));
  }
};

}  // namespace copse
