#include "lib/analysis/tree/leaf_arrays.h"

#include "lib/analysis/tree/constant_step.h"
#include "lib/analysis/tree/corner_columns.h"

#include <algorithm>
#include <span>

namespace copse {
namespace {

using Indices = std::vector<std::uint32_t>;

Indices leaf_materials(const Mesh& mesh, const LeafGeometry& geometry, std::uint64_t& mixed) {
  Indices materials(geometry.count());
  for (std::uint32_t leaf = 0; leaf < materials.size(); ++leaf) {
    const std::span<const std::uint32_t> triangles = geometry.of(leaf);
    const auto material_of = [&](std::uint32_t t) { return mesh.parts[mesh.part_of[t]].material; };
    materials[leaf] = material_of(triangles.front());
    mixed += std::any_of(triangles.begin(), triangles.end(),
                         [&](std::uint32_t t) { return material_of(t) != materials[leaf]; });
  }
  return materials;
}

}  // namespace

LeafArrays make_leaf_arrays(const Mesh& mesh, const LeafGeometry& geometry, const Double3& origin) {
  LeafArrays out;
  store_materials(leaf_materials(mesh, geometry, out.mixed_materials), out.leaves.material,
                  out.leaves.materials);
  std::vector<Float3> points(geometry.count());
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = to_float(geometry.centres[i] - origin);
  out.leaves.centres = std::move(points);

  CornerColumns columns(mesh, geometry.triangles.size());
  Indices stored(mesh.positions.size(), k_none);
  std::vector<Float3> vertices;
  vertices.reserve(std::min(mesh.positions.size(), 3 * geometry.triangles.size()));
  std::vector<CornerTriangle> triangles(geometry.triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    triangles[i] = columns.corners(geometry.triangles[i]);
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t v = mesh.triangles[geometry.triangles[i]][c];
      if (stored[v] == k_none) {
        stored[v] = static_cast<std::uint32_t>(vertices.size());
        vertices.push_back(to_float(mesh.positions[v] - origin));
        out.bounds.grow(vertices.back());
      }
      triangles[i].vertex[c] = stored[v];
    }
  }
  out.leaf_factor = constant_step(geometry.first);
  if (out.leaf_factor == 0 && geometry.count() > 0) out.leaves.first_triangle = geometry.first;
  out.leaves.triangles = std::move(triangles);
  out.leaves.vertices = std::move(vertices);
  out.leaves.normals = std::move(columns.normals);
  out.leaves.texcoords = std::move(columns.texcoords);
  return out;
}

}  // namespace copse
