#include "lib/formats/export/export.h"

#include <algorithm>
#include <map>

namespace copse {
namespace {

// Appends a surface of the tree: its own vertices, normals and texture coordinates, numbered on.
class Builder {
 public:
  explicit Builder(Mesh& mesh, const Tree& tree) : mesh_(mesh), tree_(tree) {}

  void begin(std::string name, std::span<const Float3> vertices, std::span<const Float3> normals,
             std::span<const Float2> texcoords) {
    name_ = std::move(name);
    parts_.clear();
    first_vertex_ = static_cast<std::uint32_t>(mesh_.positions.size());
    first_normal_ = static_cast<std::uint32_t>(mesh_.normals.size());
    first_texcoord_ = static_cast<std::uint32_t>(mesh_.texcoords.size());
    mesh_.positions.reserve(mesh_.positions.size() + vertices.size());
    for (const Float3& v : vertices) mesh_.positions.push_back(tree_.header.origin + to_double(v));
    mesh_.normals.insert(mesh_.normals.end(), normals.begin(), normals.end());
    mesh_.texcoords.insert(mesh_.texcoords.end(), texcoords.begin(), texcoords.end());
    has_normals_ = !normals.empty();
    has_texcoords_ = !texcoords.empty();
  }

  void add(const CornerTriangle& corner, std::uint32_t material) {
    Triangle vertex{}, normal{}, texcoord{};
    for (std::size_t c = 0; c < 3; ++c) {
      vertex[c] = first_vertex_ + corner.vertex[c];
      normal[c] = has_normals_ && corner.normal[c] != k_none ? first_normal_ + corner.normal[c] : k_none;
      texcoord[c] =
          has_texcoords_ && corner.texcoord[c] != k_none ? first_texcoord_ + corner.texcoord[c] : k_none;
    }
    mesh_.triangles.push_back(vertex);
    mesh_.normal_triangles.push_back(normal);
    mesh_.texcoord_triangles.push_back(texcoord);
    mesh_.part_of.push_back(part(material));
  }

 private:
  std::uint32_t part(std::uint32_t material) {
    const auto [at, is_new] = parts_.try_emplace(material, static_cast<std::uint32_t>(mesh_.parts.size()));
    if (is_new) mesh_.parts.push_back({.object = name_, .group = name_, .material = material});
    return at->second;
  }

  Mesh& mesh_;
  const Tree& tree_;
  std::string name_;
  std::map<std::uint32_t, std::uint32_t> parts_;  // material -> part
  std::uint32_t first_vertex_ = 0, first_normal_ = 0, first_texcoord_ = 0;
  bool has_normals_ = false, has_texcoords_ = false;
};

std::uint32_t known_material(const Tree& tree, std::uint32_t material) {
  return material < tree.materials.size() ? material : k_none;
}

void add_trunk(Builder& builder, const Tree& tree) {
  const std::vector<Float3> vertices = trunk_vertices(tree);
  const Trunk& trunk = tree.trunk;
  if (vertices.empty()) return;  // the vertices were left out: triangles alone are no geometry
  builder.begin("trunk", vertices, trunk.normals, trunk.texcoords);
  for (std::size_t t = 0; t < trunk.triangles.size(); ++t) {
    builder.add(trunk.triangles[t],
                known_material(tree, trunk.materials.empty() ? trunk.material : trunk.materials[t]));
  }
}

void add_leaves(Builder& builder, const Tree& tree) {
  const Leaves& leaves = tree.leaves;
  if (leaves.vertices.empty()) return;
  builder.begin("leaves", leaves.vertices, leaves.normals, leaves.texcoords);
  if (leaves.materials.empty()) {
    for (const CornerTriangle& t : leaves.triangles) builder.add(t, known_material(tree, leaves.material));
    return;
  }
  // Where the leaves' offsets were left out nobody knows which material a triangle has.
  std::size_t t = 0;
  for (std::size_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
    for (; t < tree.first_triangle_of_leaf(leaf + 1); ++t) {
      builder.add(leaves.triangles[t], known_material(tree, leaves.materials[leaf]));
    }
  }
  for (; t < leaves.triangles.size(); ++t)
    builder.add(leaves.triangles[t], known_material(tree, leaves.material));
}

bool all_none(const std::vector<Triangle>& corners) {
  return std::all_of(corners.begin(), corners.end(),
                     [](const Triangle& t) { return t[0] == k_none && t[1] == k_none && t[2] == k_none; });
}

}  // namespace

Mesh to_mesh(const Tree& tree) {
  Mesh mesh;
  mesh.materials = tree.materials;
  mesh.textures = tree.textures;
  Builder builder(mesh, tree);
  add_trunk(builder, tree);
  add_leaves(builder, tree);
  if (all_none(mesh.normal_triangles)) mesh.normal_triangles.clear();
  if (all_none(mesh.texcoord_triangles)) mesh.texcoord_triangles.clear();
  for (Material& material : mesh.materials) {
    if (material.texture >= mesh.textures.size()) material.texture = k_none;  // the textures were left out
  }
  return mesh;
}

}  // namespace copse
