#include "lib/analysis/tree/leaf_arrays.h"

#include "lib/analysis/tree/constant_step.h"
#include "lib/analysis/tree/corner_columns.h"

#include <numeric>

namespace copse {
namespace {

using Indices = std::vector<std::uint32_t>;

// Mesh triangles leaf after leaf, in their old order inside a leaf.
struct LeafTriangles {
  Indices first;  // leaves + 1 offsets
  Indices triangle;
};

LeafTriangles by_leaf(std::span<const std::uint32_t> leaf_of, std::size_t leaves) {
  LeafTriangles out;
  out.first.assign(leaves + 1, 0);
  for (const std::uint32_t leaf : leaf_of) {
    if (leaf != k_none) ++out.first[leaf + 1];
  }
  std::partial_sum(out.first.begin(), out.first.end(), out.first.begin());
  out.triangle.resize(out.first[leaves]);
  Indices next = out.first;
  for (std::uint32_t t = 0; t < leaf_of.size(); ++t) {
    if (leaf_of[t] != k_none) out.triangle[next[leaf_of[t]]++] = t;
  }
  return out;
}

Indices leaf_materials(const Mesh& mesh, const LeafTriangles& sorted, std::uint64_t& mixed) {
  Indices materials(sorted.first.size() - 1);
  for (std::size_t leaf = 0; leaf < materials.size(); ++leaf) {
    const auto material_of = [&](std::uint32_t i) {
      return mesh.parts[mesh.part_of[sorted.triangle[i]]].material;
    };
    materials[leaf] = material_of(sorted.first[leaf]);
    for (std::uint32_t i = sorted.first[leaf]; i < sorted.first[leaf + 1]; ++i) {
      if (material_of(i) != materials[leaf]) {
        ++mixed;
        break;
      }
    }
  }
  return materials;
}

}  // namespace

LeafArrays make_leaf_arrays(const Mesh& mesh, std::span<const std::uint32_t> leaf_of,
                            std::span<const Double3> centres, const Double3& origin) {
  LeafArrays out;
  LeafTriangles sorted = by_leaf(leaf_of, centres.size());
  store_materials(leaf_materials(mesh, sorted, out.mixed_materials), out.leaves.material,
                  out.leaves.materials);
  std::vector<Float3> points(centres.size());
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = to_float(centres[i] - origin);
  out.leaves.centres = std::move(points);

  CornerColumns columns(mesh);
  Indices stored(mesh.positions.size(), k_none);
  std::vector<Float3> vertices;
  std::vector<CornerTriangle> triangles(sorted.triangle.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    triangles[i] = columns.corners(sorted.triangle[i]);
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t v = mesh.triangles[sorted.triangle[i]][c];
      if (stored[v] == k_none) {
        stored[v] = static_cast<std::uint32_t>(vertices.size());
        vertices.push_back(to_float(mesh.positions[v] - origin));
        out.bounds.grow(vertices.back());
      }
      triangles[i].vertex[c] = stored[v];
    }
  }
  out.leaf_factor = constant_step(sorted.first);
  if (out.leaf_factor == 0 && !centres.empty()) out.leaves.first_triangle = std::move(sorted.first);
  out.leaves.triangles = std::move(triangles);
  out.leaves.vertices = std::move(vertices);
  out.leaves.normals = std::move(columns.normals);
  out.leaves.texcoords = std::move(columns.texcoords);
  return out;
}

}  // namespace copse
