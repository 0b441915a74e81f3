// What treeplay draws: a tree, a mesh or an ecosystem, with its materials and images, ready to be uploaded.
#pragma once

#include "lib/formats/ecosystem.h"
#include "lib/formats/import/image.h"
#include "lib/formats/material.h"
#include "lib/formats/result.h"
#include "lib/runtime/skeleton.h"
#include "lib/runtime/sky_light.h"
#include "lib/runtime/tree_geometry.h"
#include "tools/common/tool.h"
#include "tools/treeplay/lines_points.h"
#include "tools/treeplay/pruned_foliage.h"
#include "tools/treeplay/tree_levels.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace copse::treeplay {

// One instance as a GPU takes it: the rows of a 3 x 4 matrix from the tree's frame to the scene's, and a
// tint.
struct DrawCopy {
  std::array<Float4, 3> rows{Float4{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
  std::array<std::uint8_t, 4> tint{255, 255, 255, 255};  // sRGB
};
Float3 moved(const DrawCopy& copy, const Float3& p);

// Ranges of the geometry that are drawn once for each of a run of copies.
struct DrawGroup {
  std::uint32_t first_range = 0, range_count = 0;
  std::uint32_t first_copy = 0, instance_count = 0;
  std::uint64_t triangles = 0;  // of one copy
  // Of an ecosystem: so many groups behind it draw the same copies at coarser levels, from these distances
  // on (metres, of a tree at scale 1; ascending). Those have no copies of their own.
  std::vector<float> coarser{};
};

// Copies of one group that stand in one block of an ecosystem.
struct CopyRun {
  std::uint32_t group = 0, first = 0, count = 0;
};

struct Scene {
  std::string name;  // of the file, without its folder
  bool is_tree = false;
  TreeGeometry geometry;
  std::vector<DrawGroup> groups;  // at least one; of an ecosystem the first is its terrain
  std::vector<DrawCopy> copies;   // group after group
  std::optional<Ecosystem> eco;
  std::vector<CopyRun> runs;                 // of an ecosystem, block after block
  std::vector<std::uint32_t> first_run;      // blocks + 1
  std::shared_ptr<const TreeLevels> levels;  // of a tree that has them, when they were asked for
  std::optional<LinesPoints> lines_points;   // of a tree, when they were asked for
  std::optional<PrunedFoliage> foliage;      // of a tree with foliage cells, when they were asked for
  std::vector<Float3> full_detail;           // then: the vertices of full detail
  std::optional<Skeleton> skeleton;          // of a tree that has a hierarchy, lines or leaf groups
  std::vector<Material> materials;
  std::vector<std::optional<Image>> images;  // one a texture; empty: could not be read
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

// An image of a texture in `file`; what cannot be read is warned about.
std::optional<Image> read_texture(const Texture& texture, std::size_t index,
                                  const std::filesystem::path& file, Context& context);

// Reads a .tree, .stree or .eco, or any mesh that treeprep reads. Images that cannot be read are warned about
// and give way to the material's mean colour. `lights`: whether anything lit will be drawn; if not, `sky` is
// open.
// What of a tree is loaded beside its surface; a mesh or an ecosystem has neither.
struct Wanted {
  bool levels = false, lines_points = false, foliage = false;
};
Result<Scene> load_scene(const std::filesystem::path& path, bool lights, const Wanted& wanted,
                         Context& context);

}  // namespace copse::treeplay
