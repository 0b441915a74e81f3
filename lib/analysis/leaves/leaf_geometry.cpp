#include "lib/analysis/leaves/leaf_geometry.h"

#include <algorithm>
#include <tuple>

namespace copse {
namespace {

bool before(const Double3& a, const Double3& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

// The mean of the distinct ones; `points` is used up. Taken about one of them: far from the origin sums would
// lose digits.
Double3 mean_of_distinct(std::vector<Double3>& points) {
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  Double3 sum;
  for (const Double3& p : points) sum += p - points[0];
  return points[0] + sum / static_cast<double>(points.size());
}

double area_of(const Mesh& mesh, std::uint32_t triangle) {
  const Triangle& t = mesh.triangles[triangle];
  const Double3& a = mesh.positions[t[0]];
  return length(cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a)) / 2;
}

double coverage_of(const Mesh& mesh, std::uint32_t triangle) {
  const std::uint32_t m = mesh.parts[mesh.part_of[triangle]].material;
  return m < mesh.materials.size() ? double{mesh.materials[m].alpha_coverage} : 1;
}

}  // namespace

LeafGeometry leaf_geometry(const Mesh& mesh, std::span<const std::uint32_t> leaf_of,
                           std::uint32_t leaf_count) {
  LeafGeometry out;
  out.first.assign(leaf_count + std::size_t{1}, 0);
  for (const std::uint32_t leaf : leaf_of) {
    if (leaf != k_none) ++out.first[leaf];
  }
  std::uint32_t sum = 0;
  for (std::uint32_t& n : out.first) n = sum += n;
  out.triangles.resize(sum);
  for (std::size_t t = leaf_of.size(); t-- > 0;) {
    if (leaf_of[t] != k_none) out.triangles[--out.first[leaf_of[t]]] = static_cast<std::uint32_t>(t);
  }
  out.centres.resize(leaf_count);
  out.areas.resize(leaf_count);
  std::vector<Double3> points;
  for (std::uint32_t leaf = 0; leaf < leaf_count; ++leaf) {
    const std::span<const std::uint32_t> triangles = out.of(leaf);
    if (triangles.empty()) continue;
    points.clear();
    for (const std::uint32_t t : triangles) {
      out.areas[leaf] += area_of(mesh, t);
      for (const std::uint32_t v : mesh.triangles[t]) points.push_back(mesh.positions[v]);
    }
    out.areas[leaf] *= coverage_of(mesh, triangles[0]);
    out.centres[leaf] = mean_of_distinct(points);
  }
  return out;
}

}  // namespace copse
