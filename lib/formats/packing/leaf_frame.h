// How the vertices and normals of a packed leaf follow from its shape and its frame: what the encoder tries
// and the decoder does. Places are in steps of the grid. + - * / and square roots alone: the same everywhere.
#pragma once

#include "lib/formats/packing/pack_leaves.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace copse {

inline constexpr double k_leaf_unit = 65536;  // of a shape's places: the length of the first edge
inline constexpr double k_near_unit = 16;     // of PackedShape::near: a step

inline Double3 real(const Grid3& a) {
  return {double(a[0]), double(a[1]), double(a[2])};
}

// Right-handed, x along the first edge.
struct LeafFrame {
  Double3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  double length = 0;  // of the first edge

  Double3 out_of(const Double3& p) const { return x * p.x + y * p.y + z * p.z; }
  Double3 into(const Double3& p) const { return {dot(p, x), dot(p, y), dot(p, z)}; }
};

inline Double3 across(const Double3& x) {
  const Double3 a{std::abs(x.x), std::abs(x.y), std::abs(x.z)};
  const Double3 axis = a.x <= a.y && a.x <= a.z ? Double3{1, 0, 0}
                       : a.y <= a.z             ? Double3{0, 1, 0}
                                                : Double3{0, 0, 1};
  return normalized(cross(x, axis), {0, 1, 0});
}

// By three corners.
inline LeafFrame leaf_frame(const Double3& a, const Double3& b, const Double3& c) {
  LeafFrame f;
  f.length = distance(a, b);
  f.x = normalized(b - a, {1, 0, 0});
  const Double3 e = c - a;
  f.y = normalized(e - f.x * dot(e, f.x), across(f.x));
  f.z = cross(f.x, f.y);
  return f;
}

// By the first edge and a turn round it.
inline LeafFrame leaf_frame(const Double3& edge, bool half, double t) {
  LeafFrame f;
  f.length = length(edge);
  f.x = normalized(edge, {1, 0, 0});
  const Double3 y = across(f.x), z = cross(f.x, y);
  const double d = 1 + t * t, c = (half ? -1 : 1) * (1 - t * t) / d, s = (half ? -1 : 1) * 2 * t / d;
  f.y = y * c + z * s;
  f.z = cross(f.x, f.y);
  return f;
}

// A power of two: so many turns a quarter that the farthest corner is within a quarter of a step.
inline double turn_units(const Double3& edge) {
  double units = 16;
  while (units < 2 * length(edge) && units < 1e6) units *= 2;
  return units;
}

// The places of a leaf's vertices, in steps.
inline std::vector<Double3> leaf_places(const PackedLeaf& leaf, const PackedShape& shape,
                                        std::uint32_t count) {
  std::vector<Double3> out;
  for (std::size_t v = 0; v < (leaf.framed ? 2 : count); ++v) out.push_back(real(leaf.vertices[v]));
  if (!leaf.framed) return out;
  const Double3 edge = out[1] - out[0];
  const LeafFrame f = leaf_frame(edge, leaf.half, double(leaf.turn) / turn_units(edge));
  for (const Grid3& p : shape.places) out.push_back(out[0] + f.out_of(real(p) * (f.length / k_leaf_unit)));
  return out;
}

inline LeafFrame leaf_frame(const std::vector<Double3>& places) {
  if (places.size() < 3) return {};
  return leaf_frame(places[0], places[1], places[2]);
}

inline Double3 leaf_normal(const PackedShape& shape, const LeafFrame& frame,
                           const std::vector<Double3>& places, std::uint32_t wedge, std::uint32_t vertex,
                           const Grid3* centre) {
  switch (shape.normals) {
    case LeafNormals::fixed:
      return frame.out_of(to_double(from_octahedral(shape.fixed[wedge])));
    case LeafNormals::from_point: {
      const Double3 from = real(shape.near) / k_near_unit + real(shape.far) * (frame.length / k_leaf_unit);
      return normalized(places[vertex] - places[0] - frame.out_of(from), frame.z);
    }
    case LeafNormals::from_centre:
      return normalized(places[vertex] - real(*centre), frame.z);
    default:
      return frame.z;
  }
}

}  // namespace copse
