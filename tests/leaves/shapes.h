// Small meshes to classify: cards, tubes, balls, each added to a part of a mesh.
#pragma once

#include "lib/formats/mesh.h"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <numbers>
#include <string>
#include <vector>

namespace copse::shapes {

inline const std::filesystem::path k_trees = COPSE_SOURCE_DIR "/../shared/trees";

// Tests on real trees are skipped, in plain words, where those are not.
inline bool have_trees() {
  if (std::filesystem::exists(k_trees)) return true;
  std::cout << "  SKIPPED: no real trees at " << k_trees << '\n';
  return false;
}

// Whatever is added belongs to the part begun last.
class Builder {
 public:
  Mesh mesh;

  Builder() { part("", k_none); }
  void part(const std::string& object, std::uint32_t material = k_none, const std::string& group = "") {
    mesh.parts.push_back({object, group, material});
  }
  std::uint32_t material(const std::string& name) {
    mesh.materials.emplace_back().name = name;
    return static_cast<std::uint32_t>(mesh.materials.size() - 1);
  }

  std::uint32_t point(const Double3& p) {
    mesh.positions.push_back(p);
    return static_cast<std::uint32_t>(mesh.positions.size() - 1);
  }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.triangles.push_back({a, b, c});
    mesh.part_of.push_back(static_cast<std::uint32_t>(mesh.parts.size() - 1));
  }
  void triangle(const Double3& a, const Double3& b, const Double3& c) {
    triangle(point(a), point(b), point(c));
  }

  // A rectangle of its own four points; u and v reach from its centre to its sides.
  void card(const Double3& centre, const Double3& u, const Double3& v) {
    const std::uint32_t a = point(centre - u - v), b = point(centre + u - v), c = point(centre + u + v),
                        d = point(centre - u + v);
    triangle(a, b, c), triangle(a, c, d);
  }

  // A tube of `sides` sides through the points of `axis`, open at both ends, its seam repeated and jittered
  // by `seam`.
  void tube(const std::vector<Double3>& axis, double radius, int sides, double seam = 0) {
    const Double3 along = normalized(axis.back() - axis.front());
    const Double3 u = normalized(cross(along, std::abs(along.y) < 0.9 ? Double3{0, 1, 0} : Double3{1, 0, 0}));
    const Double3 w = cross(along, u);
    std::vector<std::uint32_t> before;
    for (const Double3& centre : axis) {
      std::vector<std::uint32_t> ring;
      for (int i = 0; i <= sides; ++i) {
        const double a = 2 * std::numbers::pi * (i % sides) / sides;
        const Double3 jitter = i == sides ? Double3{seam, -seam, seam} : Double3{};
        ring.push_back(point(centre + (u * std::cos(a) + w * std::sin(a)) * radius + jitter));
      }
      for (int i = 0; i < sides && !before.empty(); ++i) {
        triangle(before[i], before[i + 1], ring[i + 1]), triangle(before[i], ring[i + 1], ring[i]);
      }
      before = ring;
    }
  }

  // A closed ball of latitude bands, poles repeated, scaled along y.
  void ball(const Double3& centre, double radius, double tall = 1, int bands = 5, int sides = 8) {
    const auto at = [&](int b, int s) {
      const double a = std::numbers::pi * b / bands, e = 2 * std::numbers::pi * (s % sides) / sides;
      return centre +
             Double3{std::sin(a) * std::cos(e), tall * std::cos(a), std::sin(a) * std::sin(e)} * radius;
    };
    for (int b = 0; b < bands; ++b) {
      for (int s = 0; s < sides; ++s) {
        if (b > 0) triangle(at(b, s), at(b, s + 1), at(b + 1, s + 1));
        if (b + 1 < bands) triangle(at(b, s), at(b + 1, s + 1), at(b + 1, s));
      }
    }
  }
};

inline std::vector<Double3> line(const Double3& from, const Double3& to, int rings) {
  std::vector<Double3> axis;
  for (int i = 0; i < rings; ++i) axis.push_back(from + (to - from) * (i / double(rings - 1)));
  return axis;
}

}  // namespace copse::shapes
