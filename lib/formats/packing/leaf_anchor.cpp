#include "lib/formats/packing/leaf_anchor.h"

#include <algorithm>
#include <cmath>

namespace copse {
namespace {

// Across the first edge: along the axis, and across both.
struct Across {
  Double3 x, y, z;
};

Across across_edge(const Double3& edge, const Double3& axis) {
  Across a;
  a.x = normalized(edge, {1, 0, 0});
  a.y = normalized(axis - a.x * dot(axis, a.x), across(a.x));
  a.z = cross(a.x, a.y);
  return a;
}

// Cosine and sine of the turn against the frame that has none.
std::array<double, 2> circle_of(const LeafLean& lean, const Double3& edge, const Double3& axis) {
  const Across a = across_edge(edge, axis);
  const Double3 y = a.y * lean[0] + a.z * lean[1], base = across(a.x);
  return {dot(y, base), dot(y, cross(a.x, base))};
}

}  // namespace

int LeafLimb::along_bits() const {
  const double size = distance(from, to);
  int bits = 0;
  while (bits < 24 && std::ldexp(1.0, bits) < size) ++bits;
  return bits;
}

Double3 LeafLimb::point(std::uint32_t along) const {
  return from + (to - from) * std::ldexp(double(along), -along_bits());
}

Double3 LeafLimb::axis(std::uint32_t along) const {
  const double t = std::ldexp(double(along), -along_bits());
  return normalized(from_axis * (1 - t) + to_axis * t, {0, 1, 0});
}

LeafAnchors::LeafAnchors(const PackedTrunk& trunk, std::uint32_t roots) : parent_(parents_of(trunk, roots)) {
  std::size_t first = 0;
  for (std::uint32_t r = 0; r < trunk.radii.size(); ++r) {
    const PackedRadius& x = trunk.radii[r];
    centres_.push_back(real(x.centre));
    Double3 normal{};
    for (std::size_t j = 0; j < x.vectors; ++j)
      normal += cross(real(trunk.vectors[first + j]), real(trunk.vectors[first + (j + 1) % x.vectors]));
    first += x.vectors;
    normals_.push_back(normalized(normal, {}));
    if (x.group < 0) continue;
    const auto group = static_cast<std::size_t>(x.group);
    if (group >= radius_of_group_.size()) radius_of_group_.resize(group + 1, k_none);
    if (radius_of_group_[group] == k_none) radius_of_group_[group] = r;
  }
}

std::uint32_t LeafAnchors::radius_above(std::size_t group, std::uint32_t up) const {
  if (group >= radius_of_group_.size()) return k_none;
  std::uint32_t r = radius_of_group_[group];
  for (; up > 0 && r != k_none; --up) r = parent_[r];
  return r;
}

std::optional<LeafLimb> LeafAnchors::limb(std::uint32_t r) const {
  if (r >= parent_.size() || parent_[r] == k_none) return std::nullopt;
  const std::uint32_t p = parent_[r];
  LeafLimb out{.from = centres_[p], .to = centres_[r], .from_axis = {}, .to_axis = {}};
  const Double3 way = normalized(out.to - out.from, {0, 1, 0});
  const auto axis = [&](std::uint32_t end) {
    const double along = dot(normals_[end], way);
    return along > 0.5 ? normals_[end] : along < -0.5 ? normals_[end] * -1.0 : way;
  };
  out.from_axis = axis(p), out.to_axis = axis(r);
  return out;
}

LeafLean lean_of(const LeafFrame& frame, const Double3& axis) {
  const Across a = across_edge(frame.x, axis);
  return {dot(frame.y, a.y), dot(frame.y, a.z)};
}

double turn_of(const LeafLean& lean, const Double3& edge, const Double3& axis, bool half) {
  const auto [c, s] = circle_of(lean, edge, axis);
  const double cosine = half ? -c : c, sine = half ? -s : s;
  return std::clamp(sine / std::max(1 + cosine, 1e-3), -2.0, 2.0);
}

LeafTurn turn_of(const LeafLean& lean, const Double3& edge, const Double3& axis) {
  const bool half = circle_of(lean, edge, axis)[0] < 0;
  return {half, turn_of(lean, edge, axis, half)};
}

}  // namespace copse
