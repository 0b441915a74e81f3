#include "lib/analysis/tree/lone_segment.h"

#include <algorithm>

namespace copse {
namespace {

// Of the vertices that triangles use; the lowest of several.
Double3 farthest_from(const Double3& from, const TrunkMesh& trunk) {
  Double3 best = from;
  double far = -1;
  for (const Triangle& t : trunk.triangles) {
    for (const std::uint32_t v : t) {
      const double d = distance(trunk.positions[v], from);
      if (d > far) far = d, best = trunk.positions[v];
    }
  }
  return best;
}

Double3 mean_corner(const TrunkMesh& trunk) {
  Double3 sum{};
  for (const Triangle& t : trunk.triangles) {
    for (const std::uint32_t v : t)
      sum += trunk.positions[v] / (3.0 * static_cast<double>(trunk.triangles.size()));
  }
  return sum;
}

double mean_distance_to_line(const Double3& a, const Double3& b, const TrunkMesh& trunk) {
  const Double3 along = normalized(b - a);
  double sum = 0;
  for (const Triangle& t : trunk.triangles) {
    for (const std::uint32_t v : t) {
      const Double3 d = trunk.positions[v] - a;
      sum += length(d - along * dot(d, along));
    }
  }
  return sum / (3.0 * static_cast<double>(trunk.triangles.size()));
}

}  // namespace

bool add_lone_segment(const TrunkMesh& trunk, Hierarchy& hierarchy) {
  const bool has_segment = std::any_of(hierarchy.radii.begin(), hierarchy.radii.end(),
                                       [](const RadiusNode& r) { return r.parent != k_none && !r.joint; });
  if (trunk.triangles.empty() || has_segment) return false;
  if (hierarchy.radii.empty()) {
    RadiusNode root;
    root.centre = farthest_from(mean_corner(trunk), trunk);
    root.source = RadiusSource::surface;
    hierarchy.radii.push_back(root);
    hierarchy.first_vertex.push_back(hierarchy.first_vertex.back());
  }
  RadiusNode tip = hierarchy.radii.front();
  tip.parent = 0;
  tip.source = RadiusSource::surface;
  tip.centre = farthest_from(hierarchy.radii.front().centre, trunk);
  tip.diameter = 2 * mean_distance_to_line(hierarchy.radii.front().centre, tip.centre, trunk);
  if (hierarchy.radii.front().diameter == 0) hierarchy.radii.front().diameter = tip.diameter;
  hierarchy.radii.push_back(tip);
  hierarchy.first_vertex.push_back(hierarchy.first_vertex.back());
  hierarchy.notes.push_back(
      "no segment was found in the trunk: one line from end to end stands for all of it");
  return true;
}

}  // namespace copse
