#include "lib/analysis/measure/cylinder_error.h"

#include <algorithm>
#include <cmath>

namespace copse {
namespace {

struct Sample {
  double error = 0, weight = 0;
};

ErrorDistribution summarize(std::vector<Sample>& samples) {
  ErrorDistribution d;
  double total = 0, sum = 0, squares = 0;
  for (const Sample& s : samples) {
    total += s.weight, sum += s.weight * s.error, squares += s.weight * s.error * s.error;
    d.max = std::max(d.max, s.error);
  }
  if (total <= 0) return d;
  d.mean = sum / total;
  d.rms = std::sqrt(squares / total);
  std::sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) {
    return a.error != b.error ? a.error < b.error : a.weight < b.weight;
  });
  double below = 0;
  for (const Sample& s : samples) {
    below += s.weight;
    if (below >= 0.95 * total) {
      d.p95 = s.error;
      break;
    }
  }
  return d;
}

// The frustum between two radii, and how far a point is from it.
struct Frustum {
  Double3 base, axis;
  double length_squared = 0, base_radius = 0, top_radius = 0;

  Frustum(const RadiusNode& parent, const RadiusNode& child)
      : base(parent.centre),
        axis(child.centre - parent.centre),
        length_squared(dot(axis, axis)),
        base_radius(parent.diameter / 2),
        top_radius(child.diameter / 2) {}

  double parameter(const Double3& p) const {
    return length_squared > 0 ? std::clamp(dot(p - base, axis) / length_squared, 0.0, 1.0) : 0.0;
  }
  double radius(double t) const { return base_radius + t * (top_radius - base_radius); }
};

}  // namespace

CylinderError cylinder_error(const TrunkMesh& trunk, const Hierarchy& hierarchy, double height) {
  std::vector<Sample> of_radius, of_height;
  double area_all = 0, area_explained = 0;
  std::size_t explained = 0;
  for (std::size_t i = 0; i < trunk.triangles.size(); ++i) {
    const Triangle& t = trunk.triangles[i];
    const Double3 &a = trunk.positions[t[0]], &b = trunk.positions[t[1]], &c = trunk.positions[t[2]];
    const double area = 0.5 * length(cross(b - a, c - a));
    area_all += area;
    const std::uint32_t s = hierarchy.segment_of[i];
    if (s == k_none || hierarchy.radii[s].parent == k_none) continue;
    ++explained, area_explained += area;
    const Frustum frustum(hierarchy.radii[hierarchy.radii[s].parent], hierarchy.radii[s]);
    for (const std::uint32_t v : t) {
      const Double3& p = trunk.positions[v];
      const double u = frustum.parameter(p), r = frustum.radius(u);
      const double error = std::abs(distance(p, frustum.base + frustum.axis * u) - r);
      if (r > 0) of_radius.push_back({error / r, area / 3});
      if (height > 0) of_height.push_back({error / height, area / 3});
    }
  }
  CylinderError out;
  out.of_radius = summarize(of_radius);
  out.of_height = summarize(of_height);
  if (!trunk.triangles.empty()) {
    out.explained_triangles = static_cast<double>(explained) / static_cast<double>(trunk.triangles.size());
    out.explained_area = area_all > 0 ? area_explained / area_all : out.explained_triangles;
  }
  return out;
}

}  // namespace copse
