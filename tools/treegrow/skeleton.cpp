#include "tools/treegrow/skeleton.h"

#include "tools/treegrow/rotation.h"

#include <algorithm>
#include <cmath>

namespace copse::grow {
namespace {

struct Place {
  std::size_t j;  // segment of the curve
  double u;       // 0 to 1 inside it
};

Place locate(std::size_t nodes, double t) {
  const double x = std::clamp(t, 0.0, 1.0) * static_cast<double>(nodes - 1);
  const auto j = std::min(static_cast<std::size_t>(x), nodes - 2);
  return {j, x - static_cast<double>(j)};
}

// The node before the first and after the last are mirrored, so that the curve leaves its ends straight.
Double3 node(const Stem& stem, std::ptrdiff_t j) {
  const auto n = static_cast<std::ptrdiff_t>(stem.nodes.size());
  if (j < 0) return stem.nodes[0] * 2 - stem.nodes[1];
  if (j >= n)
    return stem.nodes[static_cast<std::size_t>(n - 1)] * 2 - stem.nodes[static_cast<std::size_t>(n - 2)];
  return stem.nodes[static_cast<std::size_t>(j)];
}

// Weber and Penn's taper of a whole stem, z in [0, 1]: cylinder, cone, rounded end, periodic bulges.
double taper(double shape, double z, double length) {
  const double unit = shape < 1 ? shape : shape < 2 ? 2 - shape : 0;
  const double cone = 1 - unit * z;
  if (shape <= 1 || cone <= 0) return std::max(cone, 0.0);
  const double to_end = (1 - z) * length;  // in base radii
  const double depth = shape < 2 || to_end < cone ? 1 : shape - 2;
  const double phase =
      shape < 2 ? to_end : std::abs(to_end - 2 * cone * std::floor(to_end / (2 * cone) + 0.5));
  if (shape < 2 && phase >= cone) return cone;
  const double round = std::sqrt(std::max(0.0, cone * cone - (phase - cone) * (phase - cone)));
  return (1 - depth) * cone + depth * round;
}

}  // namespace

Double3 stem_position(const Stem& stem, double t) {
  const auto [j, u] = locate(stem.nodes.size(), t);
  const auto i = static_cast<std::ptrdiff_t>(j);
  const Double3 a = node(stem, i - 1), b = node(stem, i), c = node(stem, i + 1), d = node(stem, i + 2);
  return b + ((c - a) + ((a * 2 - b * 5 + c * 4 - d) + (b * 3 - a - c * 3 + d) * u) * u) * (u * 0.5);
}

Double3 stem_direction(const Stem& stem, double t) {
  const auto [j, u] = locate(stem.nodes.size(), t);
  const auto i = static_cast<std::ptrdiff_t>(j);
  const Double3 a = node(stem, i - 1), b = node(stem, i), c = node(stem, i + 1), d = node(stem, i + 2);
  const Double3 slope = (c - a) + ((a * 2 - b * 5 + c * 4 - d) * 2 + (b * 3 - a - c * 3 + d) * (3 * u)) * u;
  return normalized(slope, normalized(c - b));
}

double stem_radius(const Species& species, const Stem& stem, double t) {
  const Level& level = species.levels[stem.level];
  const double z = stem.from + t * (stem.to - stem.from);
  const double whole = stem.length / std::max(1e-9, stem.to - stem.from);
  double radius = stem.radius * taper(level.taper, z, whole / std::max(stem.radius, 1e-12));
  const auto [j, u] = locate(stem.nodes.size(), t);
  radius *= stem.girth[j] * (1 - u) + stem.girth[j + 1] * u;
  if (stem.kind == StemKind::root && species.flare > 0)  // Weber and Penn, 4.3
    radius *= 1 + species.flare * (std::pow(100, std::max(0.0, 1 - 8 * z)) - 1) / 100;
  return radius;
}

std::vector<StemPoint> stem_points(const Species& species, const Stem& stem,
                                   const std::vector<double>& parameters) {
  std::vector<StemPoint> points;
  points.reserve(parameters.size());
  Double3 side;
  for (const double t : parameters) {
    StemPoint p;
    p.centre = stem_position(stem, t);
    p.along = stem_direction(stem, t);
    p.radius = stem_radius(species, stem, t);
    // Double reflection (Wang et al. 2008): the frame before, mirrored twice, turns as little as it can.
    if (points.empty()) {
      side = perpendicular(p.along, {1, 0, 0});
    } else {
      const StemPoint& q = points.back();
      const Double3 v = p.centre - q.centre;
      const double c = dot(v, v);
      Double3 mirrored = side, tangent = q.along;
      if (c > 0) mirrored -= v * (2 / c * dot(v, side)), tangent -= v * (2 / c * dot(v, q.along));
      const Double3 w = p.along - tangent;
      const double d = dot(w, w);
      if (d > 1e-24) mirrored -= w * (2 / d * dot(w, mirrored));
      side = perpendicular(p.along, mirrored);
    }
    p.side = side;
    p.up = cross(p.along, side);
    points.push_back(p);
  }
  return points;
}

}  // namespace copse::grow
