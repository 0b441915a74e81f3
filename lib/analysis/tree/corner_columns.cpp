#include "lib/analysis/tree/corner_columns.h"

#include <algorithm>
#include <array>
#include <utility>

namespace copse {
namespace {

template <class T>
std::array<std::uint32_t, 3> store(const Triangle& used, const std::vector<T>& all,
                                   std::vector<std::uint32_t>& stored, std::vector<T>& column) {
  std::array<std::uint32_t, 3> out{k_none, k_none, k_none};
  for (int c = 0; c < 3; ++c) {
    const std::uint32_t i = used[c];
    if (i == k_none) continue;
    if (stored[i] == k_none) stored[i] = static_cast<std::uint32_t>(column.size()), column.push_back(all[i]);
    out[c] = stored[i];
  }
  return out;
}

}  // namespace

CornerColumns::CornerColumns(const Mesh& mesh, std::size_t triangles) : mesh_(mesh) {
  // Columns that grew would be copied, and take up twice the memory meanwhile.
  if (!mesh.normal_triangles.empty()) {
    stored_normal_.assign(mesh.normals.size(), k_none);
    normals.reserve(std::min(mesh.normals.size(), 3 * triangles));
  }
  if (!mesh.texcoord_triangles.empty()) {
    stored_texcoord_.assign(mesh.texcoords.size(), k_none);
    texcoords.reserve(std::min(mesh.texcoords.size(), 3 * triangles));
  }
}

CornerTriangle CornerColumns::corners(std::uint32_t mesh_triangle) {
  CornerTriangle out;
  if (!stored_normal_.empty()) {
    out.normal = store(mesh_.normal_triangles[mesh_triangle], mesh_.normals, stored_normal_, normals);
  }
  if (!stored_texcoord_.empty()) {
    out.texcoord =
        store(mesh_.texcoord_triangles[mesh_triangle], mesh_.texcoords, stored_texcoord_, texcoords);
  }
  return out;
}

void store_materials(std::vector<std::uint32_t> materials, std::uint32_t& constant,
                     Array<std::uint32_t>& each) {
  constant = materials.empty() ? k_none : materials.front();
  const bool alike =
      std::all_of(materials.begin(), materials.end(), [&](std::uint32_t m) { return m == constant; });
  if (alike) return;
  constant = k_none;
  each = std::move(materials);
}

}  // namespace copse
