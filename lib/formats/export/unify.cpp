#include "lib/formats/export/unify.h"

#include <array>
#include <cmath>
#include <numeric>

namespace copse {
namespace {

// Position, normal and texture coordinate of a vertex. A normal that had to be made is numbered behind those
// of the mesh, one a triangle.
struct Key {
  std::uint32_t position = 0, texcoord = k_none;
  std::uint64_t normal = k_none;
  friend bool operator==(const Key&, const Key&) = default;
};

std::uint64_t hash(const Key& key) {
  std::uint64_t h = (std::uint64_t{key.position} << 32 | key.texcoord) * 0x9e3779b97f4a7c15u;
  h = (h ^ h >> 29 ^ key.normal) * 0xbf58476d1ce4e5b9u;
  h = (h ^ h >> 32) * 0x94d049bb133111ebu;
  return h ^ h >> 31;
}

// An open-addressing table of vertices that answers in which order they first came.
class Vertices {
 public:
  explicit Vertices(std::size_t expected) {
    std::size_t slots = 16;
    while (slots < 2 * expected) slots *= 2;
    slots_.assign(slots, k_none);
  }

  std::uint32_t number(const Key& key) {
    std::size_t slot = hash(key) & (slots_.size() - 1);
    while (slots_[slot] != k_none) {
      if (keys_[slots_[slot]] == key) return slots_[slot];
      slot = (slot + 1) & (slots_.size() - 1);
    }
    const auto vertex = static_cast<std::uint32_t>(keys_.size());
    keys_.push_back(key);
    slots_[slot] = vertex;
    if (2 * keys_.size() > slots_.size()) grow();
    return vertex;
  }

  const std::vector<Key>& keys() const { return keys_; }

 private:
  void grow() {
    slots_.assign(2 * slots_.size(), k_none);
    for (std::uint32_t vertex = 0; vertex < keys_.size(); ++vertex) {
      std::size_t slot = hash(keys_[vertex]) & (slots_.size() - 1);
      while (slots_[slot] != k_none) slot = (slot + 1) & (slots_.size() - 1);
      slots_[slot] = vertex;
    }
  }

  std::vector<Key> keys_;
  std::vector<std::uint32_t> slots_;
};

bool has_direction(const Float3& n) {
  const double l = length(to_double(n));
  return is_finite(n) && l > 0;
}

Double3 face_normal(const Mesh& mesh, const Triangle& t) {
  const Double3& a = mesh.positions[t[0]];
  const Double3 u = normalized(mesh.positions[t[1]] - a, {});
  const Double3 v = normalized(mesh.positions[t[2]] - a, {});
  return normalized(cross(u, v));
}

// Whether any corner of `which` names an element of this kind.
bool any_named(const std::vector<Triangle>& corners, std::span<const std::uint32_t> which) {
  if (corners.empty()) return false;
  for (const std::uint32_t t : which) {
    for (const std::uint32_t i : corners[t]) {
      if (i != k_none) return true;
    }
  }
  return false;
}

std::vector<Float3> normals_of(const Mesh& mesh, const std::vector<Key>& keys) {
  std::vector<Float3> normals;
  normals.reserve(keys.size());
  for (const Key& key : keys) {
    const Double3 n = key.normal < mesh.normals.size()
                          ? normalized(to_double(mesh.normals[key.normal]))
                          : face_normal(mesh, mesh.triangles[key.normal - mesh.normals.size()]);
    normals.push_back(to_float(n));
  }
  return normals;
}

}  // namespace

UnifiedMesh unify(const Mesh& mesh, std::span<const std::uint32_t> which) {
  const bool with_normals = any_named(mesh.normal_triangles, which);
  UnifiedMesh out;
  out.has_texcoords = any_named(mesh.texcoord_triangles, which);
  out.triangles.reserve(which.size());
  Vertices vertices(which.size());
  for (const std::uint32_t t : which) {
    Triangle unified;
    for (std::size_t c = 0; c < 3; ++c) {
      Key key{.position = mesh.triangles[t][c]};
      if (out.has_texcoords) key.texcoord = mesh.texcoord_triangles[t][c];
      if (with_normals) {
        const std::uint32_t n = mesh.normal_triangles[t][c];
        const bool usable = n != k_none && has_direction(mesh.normals[n]);
        key.normal = usable ? n : mesh.normals.size() + t;
      }
      unified[c] = vertices.number(key);
    }
    out.triangles.push_back(unified);
  }
  const std::vector<Key>& keys = vertices.keys();
  out.position.reserve(keys.size());
  for (const Key& key : keys) out.position.push_back(key.position);
  if (out.has_texcoords) {
    out.texcoord.reserve(keys.size());
    for (const Key& key : keys) out.texcoord.push_back(key.texcoord);
  }
  if (with_normals) out.normal = normals_of(mesh, keys);
  return out;
}

std::vector<std::vector<std::uint32_t>> triangles_by_part(const Mesh& mesh) {
  std::vector<std::vector<std::uint32_t>> parts(std::max<std::size_t>(mesh.parts.size(), 1));
  if (mesh.part_of.empty()) {
    parts[0].resize(mesh.triangles.size());
    std::iota(parts[0].begin(), parts[0].end(), 0u);
    return parts;
  }
  std::vector<std::size_t> count(parts.size());
  for (const std::uint32_t part : mesh.part_of) ++count[part];
  for (std::size_t p = 0; p < parts.size(); ++p) parts[p].reserve(count[p]);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) parts[mesh.part_of[t]].push_back(t);
  return parts;
}

}  // namespace copse
