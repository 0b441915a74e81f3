// What treeplay draws: a tree, a mesh or an ecosystem, with its materials and images, ready to be uploaded.
#pragma once

#include "lib/formats/ecosystem/ecosystem.h"
#include "lib/formats/import/image.h"
#include "lib/formats/material.h"
#include "lib/formats/result.h"
#include "lib/runtime/block_culling.h"
#include "lib/runtime/skeleton.h"
#include "lib/runtime/sky_light.h"
#include "lib/runtime/tree_geometry.h"
#include "tools/common/tool.h"
#include "tools/treeplay/forest.h"
#include "tools/treeplay/lines_points.h"
#include "tools/treeplay/pruned_foliage.h"
#include "tools/treeplay/tree_levels.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace copse::treeplay {

// An image that is read when something that has it is drawn (texture_reader.h).
struct SceneTexture {
  Texture texture;
  std::filesystem::path path;  // of the image, or of the file that holds it
  std::size_t number = 0;      // in that file
};

struct Scene {
  std::string name;  // of the file, without its folder
  bool is_tree = false;
  TreeGeometry geometry;
  std::optional<Ecosystem> eco;
  Forest forest;                             // of an ecosystem: its trees and its ground in `geometry`
  std::shared_ptr<const TreeLevels> levels;  // of a tree that has them, when they were asked for
  std::optional<LinesPoints> lines_points;   // of a tree, when they were asked for
  std::optional<PrunedFoliage> foliage;      // of a tree with foliage cells, when they were asked for
  std::vector<Float3> full_detail;           // then: the vertices of full detail
  std::optional<Skeleton> skeleton;          // of a tree that has a hierarchy, lines or leaf groups
  std::vector<Material> materials;
  std::vector<SceneTexture> textures;  // of the materials
  std::function<void(const std::string&)> warn = [](const std::string&) {};
  SkyLight sky;
  double ground = 0;  // absolute height

  std::uint64_t triangles() const;                 // of all instances
  std::vector<Float3> outline() const;             // points whose box and silhouette are the scene's
  DoubleBox bounds() const;                        // absolute
  double size() const;                             // the diagonal of the bounds; 1 when there is nothing
  double distance_from(const Double3& eye) const;  // to the middle of the bounds
  Double3 foot() const;                            // where it stands: the middle of its bounds, on the ground
};

// The material of a range, with a colour that suits its part when the file names none.
Material material_of(const Scene& scene, const DrawRange& range);

// Appends the textures of a file; notes the images beside it that `used` textures are, where they exist.
void add_textures(Scene& scene, std::vector<Texture>&& textures, const std::vector<bool>& used,
                  const std::filesystem::path& file, Context& context);

bool is_ecosystem(const std::filesystem::path& path);  // by its name

// Reads a .tree, .stree or .eco, or any mesh that treeprep reads. Images that cannot be read are warned about
// and give way to the material's mean colour. `lights`: whether anything lit will be drawn; if not, `sky` is
// open.
// What of a tree is loaded beside its surface; a mesh or an ecosystem has neither. What an ecosystem is
// culled by: one without it is refused before its trees are read.
struct Wanted {
  bool levels = false, lines_points = false, foliage = false;
  BlockHierarchy cull = BlockHierarchy::boxes;
};
Result<Scene> load_scene(const std::filesystem::path& path, bool lights, const Wanted& wanted,
                         Context& context);

}  // namespace copse::treeplay
