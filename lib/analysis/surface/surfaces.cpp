#include "lib/analysis/surface/surfaces.h"

#include "lib/analysis/surface/components.h"

namespace copse {
namespace {

// Sorts 0 .. of.size() - 1 into buckets by `of`, stably; k_none belongs nowhere.
void bucket(std::span<const std::uint32_t> of, std::uint32_t count, std::vector<std::uint32_t>& first,
            std::vector<std::uint32_t>& members) {
  first.assign(count + 1, 0);
  for (const std::uint32_t b : of) {
    if (b != k_none) ++first[b + 1];
  }
  for (std::uint32_t b = 0; b < count; ++b) first[b + 1] += first[b];
  members.resize(first[count]);
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (std::uint32_t i = 0; i < of.size(); ++i) {
    if (of[i] != k_none) members[next[of[i]]++] = i;
  }
}

}  // namespace

Surfaces make_surfaces(const TrunkMesh& mesh) {
  const Components components = connected_components(mesh.triangles);
  std::vector<std::uint32_t> surface_of_vertex(mesh.positions.size(), k_none);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) surface_of_vertex[v] = components.of[t];
  }
  Surfaces surfaces;
  bucket(components.of, components.count, surfaces.first_triangle, surfaces.triangle);
  bucket(surface_of_vertex, components.count, surfaces.first_vertex, surfaces.vertex);
  return surfaces;
}

}  // namespace copse
