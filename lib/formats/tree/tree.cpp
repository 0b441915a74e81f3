#include "lib/formats/tree/tree.h"

namespace copse {
namespace {

std::size_t runs(std::uint32_t constant, const Array<std::uint32_t>& offsets, std::size_t elements) {
  if (constant != 0) return elements / constant;
  return offsets.empty() ? 0 : offsets.size() - 1;
}

}  // namespace

std::size_t Tree::segment_count() const {
  if (!trunk.diameters.empty()) return trunk.diameters.size();
  if (!trunk.lines.empty()) return trunk.lines.size();
  if (!trunk.accumulated_lengths.empty()) return trunk.accumulated_lengths.size();
  return runs(header.segment_factor, trunk.first_triangle, trunk.triangles.size());
}

std::size_t Tree::leaf_count() const {
  if (!leaves.centres.empty()) return leaves.centres.size();
  if (!leaves.order.empty()) return leaves.order.size();
  if (!leaves.materials.empty()) return leaves.materials.size();
  return runs(header.leaf_factor, leaves.first_triangle, leaves.triangles.size());
}

std::vector<std::uint32_t> parents(const Tree& tree) {
  const Array<Radius>& radii = tree.hierarchy.radii;
  std::vector<std::uint32_t> parent(radii.size(), k_none);
  for (std::uint32_t r = 0; r < radii.size(); ++r) {
    if (radii[r].flags & Radius::terminal) continue;
    for (std::uint32_t c = 0; c < radii[r].child_count; ++c) parent[radii[r].first_child + c] = r;
  }
  return parent;
}

std::vector<Double3> absolute_centres(const Tree& tree) {
  const Array<Radius>& radii = tree.hierarchy.radii;
  const std::vector<std::uint32_t> parent = parents(tree);
  std::vector<Double3> centre(radii.size());
  for (std::size_t r = 0; r < radii.size(); ++r) {
    centre[r] = to_double(radii[r].centre);
    if (parent[r] != k_none) centre[r] += centre[parent[r]];
  }
  return centre;
}

std::vector<Float3> trunk_vertices(const Tree& tree) {
  if (tree.header.kind == TreeKind::still) return tree.trunk.vertices.to_vector();
  const std::vector<Double3> centre = absolute_centres(tree);
  const Array<Float3>& vectors = tree.hierarchy.vectors;
  std::vector<Float3> vertices(vectors.size());
  if (vectors.empty()) return vertices;  // left out
  for (std::size_t r = 0; r < centre.size(); ++r) {
    for (std::size_t v = tree.first_vector_of(r); v < tree.first_vector_of(r + 1); ++v) {
      vertices[v] = to_float(centre[r] + to_double(vectors[v]));
    }
  }
  return vertices;
}

}  // namespace copse
