// What treeplay draws: one tree or one mesh, with its materials and images, ready to be uploaded.
#pragma once

#include "lib/formats/import/image.h"
#include "lib/formats/material.h"
#include "lib/formats/result.h"
#include "lib/runtime/skeleton.h"
#include "lib/runtime/sky_light.h"
#include "lib/runtime/tree_geometry.h"
#include "tools/common/tool.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace copse::treeplay {

struct Scene {
  std::string name;  // of the file, without its folder
  bool is_tree = false;
  TreeGeometry geometry;
  std::optional<Skeleton> skeleton;  // of a tree that has a hierarchy, lines or leaf groups
  std::vector<Material> materials;
  std::vector<std::optional<Image>> images;  // one a texture; empty: could not be read
  SkyLight sky;
  double ground = 0;  // absolute height

  std::uint64_t triangles() const { return geometry.indices.size() / 3; }
  DoubleBox bounds() const;  // absolute
  double size() const;       // the diagonal of the bounds; 1 when there is nothing
  Double3 foot() const;      // where it stands: the middle of its bounds, on the ground
};

// The material of a range, with a colour that suits its part when the file names none.
Material material_of(const Scene& scene, const DrawRange& range);

// Reads a .tree or .stree, or any mesh that treeprep reads. Images that cannot be read are warned about and
// give way to the material's mean colour. `lights`: whether anything lit will be drawn; if not, `sky` is
// open.
Result<Scene> load_scene(const std::filesystem::path& path, bool lights, Context& context);

}  // namespace copse::treeplay
