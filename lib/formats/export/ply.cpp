// PLY, binary little endian. Positions are float when that loses nothing, else double.
#include "lib/formats/export/export_detail.h"
#include "lib/formats/export/unify.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <numeric>

#include <fmt/format.h>

namespace copse {
namespace {

static_assert(std::endian::native == std::endian::little);

template <class T>
char* put(char* at, T value) {
  std::memcpy(at, &value, sizeof value);
  return at + sizeof value;
}

bool is_float(double v) {
  return static_cast<double>(static_cast<float>(v)) == v;
}

bool all_floats(const std::vector<Double3>& positions) {
  return std::all_of(positions.begin(), positions.end(),
                     [](const Double3& p) { return is_float(p.x) && is_float(p.y) && is_float(p.z); });
}

template <class T>
char* put_vertex(char* at, const Mesh& mesh, const UnifiedMesh& unified, std::size_t v) {
  const Double3& p = mesh.positions[unified.position[v]];
  for (int axis = 0; axis < 3; ++axis) at = put(at, static_cast<T>(p[axis]));
  if (!unified.normal.empty()) {
    for (int axis = 0; axis < 3; ++axis) at = put(at, unified.normal[v][axis]);
  }
  if (unified.has_texcoords) {
    const std::uint32_t t = unified.texcoord[v];
    const Float2 uv = t == k_none ? Float2{} : mesh.texcoords[t];
    at = put(put(at, uv.x), uv.y);
  }
  return at;
}

// A mesh without normals and texture coordinates is written as it is, with the vertices that no face uses.
UnifiedMesh as_it_is(const Mesh& mesh) {
  UnifiedMesh out;
  out.position.resize(mesh.positions.size());
  std::iota(out.position.begin(), out.position.end(), 0u);
  out.triangles = mesh.triangles;
  return out;
}

UnifiedMesh unified_mesh(const Mesh& mesh) {
  if (mesh.normal_triangles.empty() && mesh.texcoord_triangles.empty()) return as_it_is(mesh);
  std::vector<std::uint32_t> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  return unify(mesh, all);
}

}  // namespace

Result<std::vector<ExportedFile>> export_ply(const Mesh& mesh, const std::string& name) {
  const UnifiedMesh unified = unified_mesh(mesh);
  const bool floats = all_floats(mesh.positions);
  const char* type = floats ? "float" : "double";
  std::string header =
      fmt::format("ply\nformat binary_little_endian 1.0\ncomment copse {}\nelement vertex {}\n",
                  COPSE_VERSION, unified.position.size());
  for (const char axis : {'x', 'y', 'z'}) header += fmt::format("property {} {}\n", type, axis);
  std::size_t vertex_bytes = 3 * (floats ? sizeof(float) : sizeof(double));
  if (!unified.normal.empty()) {
    header += "property float nx\nproperty float ny\nproperty float nz\n";
    vertex_bytes += 3 * sizeof(float);
  }
  if (unified.has_texcoords) {
    header += "property float s\nproperty float t\n";
    vertex_bytes += 2 * sizeof(float);
  }
  header += fmt::format("element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
                        unified.triangles.size());

  constexpr std::size_t k_face_bytes = 1 + 3 * sizeof(std::uint32_t);
  std::vector<ExportedFile> files(1);
  files[0].name = name;
  std::string& out = files[0].bytes;
  out = std::move(header);
  const std::size_t begin = out.size();
  out.resize(begin + unified.position.size() * vertex_bytes + unified.triangles.size() * k_face_bytes);
  char* at = out.data() + begin;
  for (std::size_t v = 0; v < unified.position.size(); ++v) {
    at = floats ? put_vertex<float>(at, mesh, unified, v) : put_vertex<double>(at, mesh, unified, v);
  }
  for (const Triangle& t : unified.triangles) {
    at = put(at, std::uint8_t{3});
    for (const std::uint32_t i : t) at = put(at, i);
  }
  return files;
}

}  // namespace copse
