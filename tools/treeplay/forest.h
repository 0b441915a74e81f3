// The meshes of a forest: of every type of tree each level of detail once, and the ground that it stands on.
#pragma once

#include "lib/formats/ecosystem/ecosystem.h"
#include "lib/runtime/matrix.h"
#include "lib/runtime/terrain_tiles.h"
#include "lib/runtime/tree_geometry.h"
#include "tools/treeplay/tree_levels.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace copse::treeplay {

// One instance as a GPU takes it: the rows of a 3 x 4 matrix from the tree's frame to the scene's, and a
// tint.
struct DrawCopy {
  std::array<Float4, 3> rows{Float4{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
  // sRGB; the fourth says which pixels are drawn (level_ladder.h), all by itself
  std::array<std::uint8_t, 4> tint{255, 255, 255, 255};
};
Float3 moved(const DrawCopy& copy, const Float3& p);

// A type's triangles, as ranges of the scene's indices with the scene's materials.
struct ForestType {
  // Finest first: full detail, those by distance, and stochastic ones for what is a few pixels high.
  std::vector<std::vector<DrawRange>> levels;
  std::vector<float> coarser;  // metres at scale 1, ascending: from where each of those by distance is drawn
  float height = 0;            // the longest side of its box, at scale 1
  std::shared_ptr<const TreeImpostor> impostor{};  // of its own materials; null: it has none
};

// The terrain, and how it goes on round it, ever more level, into the haze: one that ends in mid-air looks
// like a slice of cake.
class ForestGround {
 public:
  ForestGround() = default;
  // Appends its vertices to those of `geometry`.
  ForestGround(const Terrain& terrain, const Double3& origin, TreeGeometry& geometry);

  // How finely each part is drawn from here on: no vertex is off by more than `tolerance` times its distance.
  void choose(const Double3& eye, double tolerance) { tiles_.choose(eye, tolerance); }
  // The triangles in the frustum, and all of what surrounds the terrain.
  void append(const Frustum& frustum, const Double3& eye, std::vector<std::uint32_t>& indices) const;

  bool empty() const { return columns_ == 0; }
  std::uint32_t material() const { return material_; }
  std::uint64_t triangles() const;  // in full detail, without what surrounds it

 private:
  std::vector<std::uint32_t> whole_border() const;
  std::uint32_t place_on_border(std::uint32_t vertex) const;
  void add_surroundings(TreeGeometry& geometry, const Terrain& terrain);

  TerrainTiles tiles_;
  std::uint32_t columns_ = 0, rows_ = 0, material_ = k_none;
  std::uint32_t first_ = 0, first_ring_ = 0;  // its vertices; those of what surrounds it
};

// The height of the terrain's triangle at a place, all absolute; outside, that of the border. None where the
// terrain is no regular grid of heights.
std::optional<double> ground_height(const Terrain& terrain, double x, double z);

// The same of any terrain: of a free surface the highest triangle over or under the place; none beside it.
// O(triangles) where the terrain is no regular grid.
std::optional<double> highest_ground(const Terrain& terrain, double x, double z);

struct Forest {
  std::vector<ForestType> types;
  ForestGround ground;
};

}  // namespace copse::treeplay
