#include "lib/analysis/trunk/fit.h"

#include "lib/analysis/rings/ring_circles.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace copse {
namespace {

// At right angles to the axis: how far a point is from the frustum between two radii.
double off_frustum(const Double3& p, const RadiusNode& base, const RadiusNode& top) {
  const Double3 axis = top.centre - base.centre;
  const double squared = dot(axis, axis);
  const double t = squared > 0 ? std::clamp(dot(p - base.centre, axis) / squared, 0.0, 1.0) : 0.0;
  const double radius = base.diameter / 2 + t * (top.diameter - base.diameter) / 2;
  return std::abs(distance(p, base.centre + axis * t) - radius);
}

}  // namespace

Fit fit_of(const Surface& surface, const Hierarchy& hierarchy) {
  DoubleBox box;
  for (const Double3& p : surface.positions) box.grow(p);
  const double size = length(box.extent());
  const RingCircles circles(hierarchy, surface.positions.size());
  double all = 0, owned = 0, off = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const Triangle& t = surface.triangles[i];
    const Double3 &a = surface.positions[t[0]], &b = surface.positions[t[1]], &c = surface.positions[t[2]];
    const double area = 0.5 * length(cross(b - a, c - a));
    all += area;
    const std::uint32_t s = hierarchy.segment_of[i];
    if (s == k_none || hierarchy.radii[s].parent == k_none) continue;
    ++count, owned += area;
    const RadiusNode &top = hierarchy.radii[s], &base = hierarchy.radii[top.parent];
    const auto along = circles.along(t, s);
    const std::array corners{&a, &b, &c};
    for (std::size_t k = 0; k < corners.size(); ++k) {
      double from = off_frustum(*corners[k], base, top);
      if (along) from = std::min(from, off_circle(*corners[k], base, top, (*along)[k]));
      off += area / 3 * from;
    }
  }
  Fit fit;
  if (owned > 0 && size > 0) fit.distance = off / owned / size;
  fit.explained = surface.triangles.empty() ? 1
                  : all > 0                 ? owned / all
                            : static_cast<double>(count) / static_cast<double>(surface.triangles.size());
  return fit;
}

}  // namespace copse
