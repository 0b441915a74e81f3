#include "lib/formats/import/gltf/gltf.h"

#include "lib/formats/import/gltf/document.h"
#include "lib/formats/import/gltf/material.h"
#include "lib/formats/import/gltf/primitive.h"
#include "lib/formats/import/gltf/scene.h"
#include "lib/formats/import/gltf/skin.h"
#include "lib/formats/import/text.h"

#include <vector>

namespace copse {
namespace {

// The nodes that hold meshes, and those above them, as groups of the source.
class NodeGroups {
 public:
  NodeGroups(const GltfDocument& document, const GltfScene& scene, MeshBuilder& builder)
      : document_(document), scene_(scene), builder_(builder), group_(scene.parents.size(), k_none) {}

  std::uint32_t of(std::uint32_t node) {
    std::vector<std::uint32_t> chain;
    for (std::uint32_t n = node; n != k_none && group_[n] == k_none; n = scene_.parents[n])
      chain.push_back(n);
    for (auto n = chain.rbegin(); n != chain.rend(); ++n) {
      const std::uint32_t parent = scene_.parents[*n];
      group_[*n] = builder_.group(name_of(*n), parent == k_none ? k_none : group_[parent]);
    }
    return group_[node];
  }

 private:
  std::string name_of(std::uint32_t node) const {
    return to_utf8(document_.root()["nodes"].at(node)["name"].text());
  }

  const GltfDocument& document_;
  const GltfScene& scene_;
  MeshBuilder& builder_;
  std::vector<std::uint32_t> group_;
};

}  // namespace

bool read_gltf(std::span<const std::uint8_t> bytes, const Companions& companions, std::uint64_t limit,
               MeshBuilder& builder) {
  GltfDocument document(companions, builder);
  GltfMaterials materials;
  GltfScene scene;
  if (!document.open(bytes) || !read_materials(document, materials) || !read_scene(document, scene))
    return false;
  PrimitiveReader primitives(document, materials, limit);
  NodeGroups groups(document, scene, builder);
  std::vector<Affine> copies;
  for (const GltfInstance& instance : scene.instances) {
    GltfSkin skin;
    if (!read_instancing(document, instance.node, copies) ||
        !read_skin(document, instance.node, scene.places, skin))
      return false;
    const std::string object = to_utf8(document.root()["nodes"].at(instance.node)["name"].text());
    for (const Affine& copy : copies) {
      const std::size_t before = builder.mesh.triangles.size();
      if (!primitives.read(instance.mesh, scene.places[instance.node] * copy, skin, object)) return false;
      if (builder.mesh.triangles.size() == before) continue;
      const std::uint32_t group = groups.of(instance.node);
      builder.close_group(copies.size() > 1 ? builder.group("", group) : group);
    }
  }
  return true;
}

}  // namespace copse
