#include "lib/formats/export/glb_geometry.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>

#include <fmt/format.h>

namespace copse {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::uint32_t k_vertex_target = 34962, k_index_target = 34963;
constexpr std::uint32_t k_uint16 = 5123, k_uint32 = 5125;
// A GLB counts its bytes in 32 bits; the JSON needs some of them.
constexpr std::uint64_t k_most_bytes = 0xf0000000u;
// Farther from the origin than this many times its own size, a mesh loses shape in float32.
constexpr double k_far = 4;

// The point that positions are stored relative to: the origin, unless the mesh lies far from it.
Double3 translation_of(const DoubleBox& box) {
  if (box.empty()) return {};
  const Double3 middle = box.min * 0.5 + box.max * 0.5;
  const Double3 half = box.max * 0.5 - box.min * 0.5;
  const double size = std::max({half.x, half.y, half.z});
  const double away = std::max({std::fabs(middle.x), std::fabs(middle.y), std::fabs(middle.z)});
  if (away <= 2 * k_far * size) return {};
  return to_double(to_float(middle));  // so that readers which keep float32 lose nothing
}

bool fits_float(const DoubleBox& box, const Double3& translation) {
  if (box.empty()) return true;
  constexpr double k_most = std::numeric_limits<float>::max();
  for (int axis = 0; axis < 3; ++axis) {
    if (!(std::fabs(translation[axis]) <= k_most) ||
        !(std::fabs(box.min[axis] - translation[axis]) <= k_most) ||
        !(std::fabs(box.max[axis] - translation[axis]) <= k_most)) {
      return false;
    }
  }
  return true;
}

template <class T>
std::string_view bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

std::array<Float3, 2> bounds_of(const std::vector<Float3>& points) {
  FloatBox box;
  for (const Float3& p : points) box.grow(p);
  return {box.min, box.max};
}

std::vector<Float3> positions_of(const Mesh& mesh, const UnifiedMesh& unified, const Double3& translation) {
  std::vector<Float3> positions;
  positions.reserve(unified.position.size());
  for (const std::uint32_t v : unified.position)
    positions.push_back(to_float(mesh.positions[v] - translation));
  return positions;
}

// glTF's texture space has its origin at the upper left. What is not finite has no place in a file.
std::vector<Float2> texcoords_of(const Mesh& mesh, const UnifiedMesh& unified) {
  std::vector<Float2> texcoords;
  if (!unified.has_texcoords) return texcoords;
  texcoords.reserve(unified.texcoord.size());
  for (const std::uint32_t t : unified.texcoord) {
    const Float2 uv = t == k_none ? Float2{} : mesh.texcoords[t];
    const bool finite = std::isfinite(uv.x) && std::isfinite(uv.y);
    texcoords.push_back(finite ? Float2{uv.x, 1 - uv.y} : Float2{0, 1});
  }
  return texcoords;
}

std::uint32_t add_accessor(GlbGeometry& out, Accessor accessor) {
  out.accessors.push_back(std::move(accessor));
  return static_cast<std::uint32_t>(out.accessors.size() - 1);
}

std::uint32_t add_indices(GlbGeometry& out, const UnifiedMesh& unified) {
  const std::uint64_t count = 3 * unified.triangles.size();
  if (unified.position.size() > 65535) {
    return add_accessor(out, {.view = out.add_view(bytes_of(unified.triangles), k_index_target),
                              .component = k_uint32,
                              .count = count,
                              .bounds = {}});
  }
  std::vector<std::uint16_t> narrow;
  narrow.reserve(count);
  for (const Triangle& t : unified.triangles) {
    for (const std::uint32_t i : t) narrow.push_back(static_cast<std::uint16_t>(i));
  }
  return add_accessor(out, {.view = out.add_view(bytes_of(narrow), k_index_target),
                            .component = k_uint16,
                            .count = count,
                            .bounds = {}});
}

void add_plain(GlbGeometry& out, Primitive primitive, const UnifiedMesh& unified,
               const std::vector<Float3>& positions, const std::vector<Float2>& texcoords) {
  primitive.indices = add_indices(out, unified);
  primitive.position = add_accessor(out, {.view = out.add_view(bytes_of(positions), k_vertex_target),
                                          .count = positions.size(),
                                          .type = "VEC3",
                                          .bounds = bounds_of(positions)});
  if (!unified.normal.empty()) {
    primitive.normal = add_accessor(out, {.view = out.add_view(bytes_of(unified.normal), k_vertex_target),
                                          .count = unified.normal.size(),
                                          .type = "VEC3",
                                          .bounds = {}});
  }
  if (unified.has_texcoords) {
    primitive.texcoord = add_accessor(out, {.view = out.add_view(bytes_of(texcoords), k_vertex_target),
                                            .count = texcoords.size(),
                                            .type = "VEC2",
                                            .bounds = {}});
  }
  out.primitives.push_back(std::move(primitive));
}

Result<void> add_draco(GlbGeometry& out, Primitive primitive, const UnifiedMesh& unified,
                       const std::vector<Float3>& positions, const std::vector<Float2>& texcoords, int bits) {
  const auto encoded = encode_draco(unified, positions, texcoords, bits);
  if (!encoded) return std::unexpected(encoded.error());
  primitive.draco = encoded->ids;
  primitive.draco->view = out.add_view(encoded->bytes, 0);
  const std::uint64_t n = encoded->vertices;
  primitive.indices = add_accessor(out, {.view = {},
                                         .component = n > 65535 ? k_uint32 : k_uint16,
                                         .count = 3 * encoded->triangles,
                                         .bounds = {}});
  primitive.position = add_accessor(out, {.view = {}, .count = n, .type = "VEC3", .bounds = encoded->bounds});
  if (!unified.normal.empty()) {
    primitive.normal = add_accessor(out, {.view = {}, .count = n, .type = "VEC3", .bounds = {}});
  }
  if (unified.has_texcoords) {
    primitive.texcoord = add_accessor(out, {.view = {}, .count = n, .type = "VEC2", .bounds = {}});
  }
  out.primitives.push_back(std::move(primitive));
  return {};
}

// Room for everything, so that gigabytes are never moved; what is not used is never touched.
std::size_t room_for(const Mesh& mesh) {
  const std::size_t vertex = sizeof(Float3) * (mesh.normal_triangles.empty() ? 1 : 2) +
                             sizeof(Float2) * (mesh.texcoord_triangles.empty() ? 0 : 1);
  std::size_t room = mesh.triangles.size() * (3 * vertex + sizeof(Triangle)) + 65536;
  for (const Texture& texture : mesh.textures) room += texture.bytes.size() + 4;
  return static_cast<std::size_t>(std::min<std::uint64_t>(room, k_most_bytes));
}

}  // namespace

std::uint32_t GlbGeometry::add_view(std::string_view bytes, std::uint32_t target) {
  views.push_back({.offset = binary.size(), .size = bytes.size(), .target = target});
  binary += bytes;
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  return static_cast<std::uint32_t>(views.size() - 1);
}

Result<GlbGeometry> glb_geometry(const Mesh& mesh, const std::string& name, const ExportOptions& options) {
  const DoubleBox box = bounds(mesh);
  GlbGeometry out;
  out.translation = translation_of(box);
  if (!fits_float(box, out.translation)) {
    return refuse(name, "a coordinate is too large for a GLB, which holds float32", "scale the mesh down");
  }
  if (!options.draco) out.binary.reserve(room_for(mesh));
  const std::vector<std::vector<std::uint32_t>> parts = triangles_by_part(mesh);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (parts[p].empty()) continue;
    const UnifiedMesh unified = unify(mesh, parts[p]);
    const std::vector<Float3> positions = positions_of(mesh, unified, out.translation);
    const std::vector<Float2> texcoords = texcoords_of(mesh, unified);
    const std::uint64_t grown =
        out.binary.size() + unified.position.size() * 32 + unified.triangles.size() * 12;
    if (grown > k_most_bytes) {
      return refuse(name, "the mesh is larger than the 4 GiB that a GLB can hold",
                    "write PLY, or split the mesh");
    }
    Primitive primitive{.part = static_cast<std::uint32_t>(p), .normal = {}, .texcoord = {}, .draco = {}};
    if (!options.draco) {
      add_plain(out, primitive, unified, positions, texcoords);
    } else if (auto done =
                   add_draco(out, primitive, unified, positions, texcoords, options.draco_position_bits);
               !done) {
      done.error().file = name;
      return std::unexpected(std::move(done.error()));
    }
  }
  return out;
}

}  // namespace copse
