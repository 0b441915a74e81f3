#include "tests/trunk/tube_maker.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace copse {
namespace {

// Two unit vectors across an axis, turned as little as possible from ring to ring.
struct Frame {
  Double3 u, v;
};

Double3 tangent(const TubeShape& s, std::size_t i) {
  const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, s.axis.size() - 1);
  return normalized(s.axis[after] - s.axis[before]);
}

Frame frame(const Double3& axis, const Double3& hint) {
  const Double3 across = hint - axis * dot(hint, axis);
  const Double3 u =
      length(across) > 1e-3
          ? normalized(across)
          : normalized(cross(axis, std::abs(axis.x) < 0.7 ? Double3{1, 0, 0} : Double3{0, 0, 1}));
  return {u, cross(axis, u)};
}

}  // namespace

void TubeMaker::add(const TubeShape& s, double point_length) {
  std::mt19937 random(s.seed);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const std::size_t first_triangle = mesh.triangles.size();
  const auto sides = static_cast<std::uint32_t>(s.sides);
  const std::uint32_t stride = sides + (s.seam ? 1 : 0);
  Double3 hint{1, 0, 0};
  for (std::size_t i = 0; i < s.axis.size(); ++i) {
    const Frame f = frame(tangent(s, i), hint);
    hint = f.u;
    for (std::uint32_t j = 0; j < stride; ++j) {
      const double a = 2 * std::numbers::pi * (j % sides + s.turn) / s.sides;
      mesh.positions.push_back(s.axis[i] + (f.u * std::cos(a) + f.v * std::sin(a)) * s.radius[i]);
    }
  }
  const auto rings = static_cast<std::uint32_t>(s.axis.size());
  const auto at = [&](std::uint32_t ring, std::uint32_t j) {
    return first + ring * stride + (s.seam ? j : j % sides);
  };
  const std::uint32_t quads = s.sides == 2 ? 1 : sides;
  for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
    for (std::uint32_t j = 0; j < quads; ++j) {
      const std::uint32_t a = at(ring, j), b = at(ring, j + 1), c = at(ring + 1, j + 1), d = at(ring + 1, j);
      const bool forward = s.diagonals == Diagonals::forward ||
                           (s.diagonals == Diagonals::alternating && (ring + j) % 2 == 0) ||
                           (s.diagonals == Diagonals::random && random() % 2 == 0);
      if (forward) {
        mesh.triangles.insert(mesh.triangles.end(), {Triangle{a, b, c}, Triangle{a, c, d}});
      } else {
        mesh.triangles.insert(mesh.triangles.end(), {Triangle{a, b, d}, Triangle{b, c, d}});
      }
    }
  }
  for (int side = 0; side < 2; ++side) {
    const TubeEnd end = side == 0 ? s.first : s.last;
    const std::uint32_t ring = side == 0 ? 0 : rings - 1;
    const Double3 outward = tangent(s, ring) * (side == 0 ? -1.0 : 1.0);
    if (end == TubeEnd::fan || end == TubeEnd::point) {
      const auto apex = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.push_back(s.axis[ring] +
                               outward * (end == TubeEnd::point ? point_length * s.radius[ring] : 0));
      for (std::uint32_t j = 0; j < sides; ++j) {
        Triangle t{at(ring, j), at(ring, j + 1), apex};
        if (side == 0) std::swap(t[0], t[1]);
        mesh.triangles.push_back(t);
      }
    }
    if (end == TubeEnd::lid) {
      for (std::uint32_t j = 1; j + 1 < sides; ++j) {
        Triangle t{at(ring, 0), at(ring, j), at(ring, j + 1)};
        if (side == 0) std::swap(t[1], t[2]);
        mesh.triangles.push_back(t);
      }
    }
  }
  if (s.split) {
    for (std::size_t t = first_triangle; t < mesh.triangles.size(); ++t) {
      for (std::uint32_t& v : mesh.triangles[t]) {
        const Double3 p = mesh.positions[v];
        v = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.push_back(p);
      }
    }
  }
  mesh.part_of.resize(mesh.triangles.size(), 0);
  mesh.parts.resize(1);
}

void TubeMaker::shuffle(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random);
  std::vector<std::uint32_t> place(mesh.positions.size());
  for (std::uint32_t i = 0; i < place.size(); ++i) place[i] = i;
  std::shuffle(place.begin(), place.end(), random);
  std::vector<Double3> moved(place.size());
  for (std::uint32_t i = 0; i < place.size(); ++i) moved[place[i]] = mesh.positions[i];
  mesh.positions = std::move(moved);
  for (Triangle& t : mesh.triangles) {
    for (std::uint32_t& v : t) v = place[v];
  }
}

std::vector<std::uint8_t> all_trunk(const Mesh& mesh) {
  return std::vector<std::uint8_t>(mesh.triangles.size(), 1);
}

std::vector<Double3> axis_between(const Double3& from, const Double3& to, int rings, double bend) {
  std::vector<Double3> axis;
  const Double3 along = to - from;
  const Double3 side =
      normalized(cross(along, std::abs(along.x) < std::abs(along.y) ? Double3{1, 0, 0} : Double3{0, 1, 0}));
  for (int i = 0; i < rings; ++i) {
    const double t = rings == 1 ? 0.0 : static_cast<double>(i) / (rings - 1);
    axis.push_back(from + along * t + side * (bend * std::sin(std::numbers::pi * t)));
  }
  return axis;
}

std::vector<double> taper_between(double from, double to, int rings) {
  std::vector<double> radius;
  for (int i = 0; i < rings; ++i) {
    radius.push_back(rings == 1 ? from : from + (to - from) * i / (rings - 1));
  }
  return radius;
}

}  // namespace copse
