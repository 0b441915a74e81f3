#include "lib/formats/import/gltf/gltf.h"

#include "lib/formats/import/gltf/document.h"
#include "lib/formats/import/gltf/material.h"
#include "lib/formats/import/gltf/primitive.h"
#include "lib/formats/import/gltf/scene.h"
#include "lib/formats/import/gltf/skin.h"
#include "lib/formats/import/text.h"

#include <vector>

namespace copse {

bool read_gltf(std::span<const std::uint8_t> bytes, const Companions& companions, std::uint64_t limit,
               MeshBuilder& builder) {
  GltfDocument document(companions, builder);
  GltfMaterials materials;
  GltfScene scene;
  if (!document.open(bytes) || !read_materials(document, materials) || !read_scene(document, scene))
    return false;
  PrimitiveReader primitives(document, materials, limit);
  std::vector<Affine> copies;
  for (const GltfInstance& instance : scene.instances) {
    GltfSkin skin;
    if (!read_instancing(document, instance.node, copies) ||
        !read_skin(document, instance.node, scene.places, skin))
      return false;
    const std::string object = to_utf8(document.root()["nodes"].at(instance.node)["name"].text());
    for (const Affine& copy : copies) {
      if (!primitives.read(instance.mesh, scene.places[instance.node] * copy, skin, object)) return false;
    }
  }
  return true;
}

}  // namespace copse
