// Puts the primitives of a glTF mesh into the mesh that is being built, placed by a transform or a skin.
#pragma once

#include "lib/formats/import/gltf/accessor.h"
#include "lib/formats/import/gltf/draco.h"
#include "lib/formats/import/gltf/material.h"
#include "lib/formats/import/gltf/scene.h"
#include "lib/formats/import/gltf/skin.h"

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <tuple>
#include <vector>

namespace copse {

class PrimitiveReader {
 public:
  // `limit`: how many triangles, and how many vertices, the scene may grow to.
  PrimitiveReader(GltfDocument& document, const GltfMaterials& materials, std::uint64_t limit)
      : document_(document), builder_(document.builder()), materials_(materials), limit_(limit) {}

  // All primitives of one mesh, placed once: by the skin if it has joints, otherwise by the transform. False:
  // refused.
  bool read(std::uint32_t mesh, const Affine& transform, const GltfSkin& skin, const std::string& object);

 private:
  // Where one primitive's numbers come from: accessors, or a Draco mesh for the attributes that it holds.
  struct Source {
    std::string path;
    JsonValue attributes;
    std::uint32_t vertices = 0;
    std::shared_ptr<const DracoMesh> draco;
    std::uint32_t draco_view = k_none;
    std::map<std::string, std::uint32_t> draco_ids;
  };
  // Primitives of one placed mesh may share an attribute; it is put into the mesh once: (Draco's buffer view,
  // accessor, texture transform) -> its first element.
  using Shared = std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::uint32_t>;

  bool primitive(const JsonValue& json, const std::string& object, const std::string& group);
  bool open(const JsonValue& json, Source& source);
  bool open_draco(const JsonValue& json, Source& source);
  bool draco_mesh(std::uint32_t view_index, std::shared_ptr<const DracoMesh>& out);
  template <class Number>
  bool numbers(const Source& source, const std::string& name, std::uint32_t components,
               std::span<Number> out);
  // Where attribute `name` begins: its place when it is known already, else `next`; k_none when there is
  // none.
  bool place_attribute(const Source& source, const std::string& name, std::uint32_t variant, std::size_t next,
                       Shared& known, std::uint32_t& base);
  bool joints(const Source& source);
  Affine place(std::size_t vertex) const;
  bool positions(const Source& source, std::uint32_t& base);
  bool normals(const Source& source, std::uint32_t& base);
  bool texcoords(const Source& source, std::uint32_t material, std::uint32_t& base);
  bool vertex_order(const JsonValue& json, const Source& source, std::vector<std::uint32_t>& out);
  bool triangles(std::span<const std::uint32_t> order, std::uint64_t mode, const Source& source,
                 const Corner& base, std::uint32_t part);
  bool within_limit(std::uint64_t total);

  GltfDocument& document_;
  MeshBuilder& builder_;
  const GltfMaterials& materials_;
  std::uint64_t limit_;

  // Of the mesh that is being placed.
  std::uint32_t mesh_ = k_none;
  Affine transform_;
  const GltfSkin* skin_ = nullptr;
  std::vector<double> joints_, weights_;  // 4 a vertex, of a primitive with a skin
  Shared positions_, normals_, texcoords_;
  std::map<std::uint32_t, std::shared_ptr<const DracoMesh>> decoded_;  // by buffer view
};

}  // namespace copse
