// A terrain in tiles, each drawn as finely as the eye can tell: the far ones by every 2nd, 4th, ... 64th
// vertex of the same array.
//
// Source: geometrical mipmaps (de Boer, "Fast terrain rendering using geometrical mipmapping", 2000): a
// tile's error at each level is measured once; a level is taken when that error, seen from the eye, stays
// below a tolerance. Where a neighbour is coarser a tile's edge takes the neighbour's vertices, so that there
// are neither cracks nor T-junctions.
#pragma once

#include "lib/formats/ecosystem/ecosystem.h"
#include "lib/runtime/camera.h"

#include <array>
#include <cstdint>
#include <vector>

namespace copse {

inline constexpr std::uint32_t k_tile_cells = 64;     // along a side
inline constexpr std::uint32_t k_terrain_levels = 7;  // steps of 1, 2, ... 64 vertices

class TerrainTiles {
 public:
  TerrainTiles() = default;
  // Measures the errors. Keeps nothing of the terrain, which must have no more than 2^32 - 1 vertices.
  // O(vertices * levels).
  explicit TerrainTiles(const Terrain& terrain);

  // Decides on the level of every tile: the coarsest whose error, in metres, is at most `tolerance` times the
  // distance of the tile's box from the eye (0: full detail everywhere). O(tiles).
  void choose(const Double3& eye, double tolerance);

  // Appends the triangles of the tiles in the frustum: three vertices each, row * columns + column,
  // counter-clockwise from above. O(tiles + triangles).
  void append(const Frustum& frustum, const Double3& eye, std::vector<std::uint32_t>& indices) const;

  // The vertices along the border that the chosen levels use, once round: first along the first row, by
  // ascending column. Empty when there is no terrain.
  void append_border(std::vector<std::uint32_t>& vertices) const;

  std::size_t tile_count() const { return tiles_.size(); }
  std::uint32_t level(std::size_t tile) const { return tiles_[tile].level; }
  // The largest distance of a vertex of the tile from its surface at a level, metres; ascending by level.
  double error(std::size_t tile, std::uint32_t level) const { return double{tiles_[tile].errors[level]}; }

 private:
  struct Tile {
    DoubleBox box;  // absolute
    std::array<float, k_terrain_levels> errors{};
    std::uint32_t level = 0;
  };
  void measure(const Terrain& terrain, std::uint32_t tile_column, std::uint32_t tile_row, Tile& tile) const;
  void append_tile(std::uint32_t tile_column, std::uint32_t tile_row,
                   std::vector<std::uint32_t>& indices) const;
  std::uint32_t level_at(std::int64_t tile_column, std::int64_t tile_row, std::uint32_t otherwise) const;

  std::uint32_t columns_ = 0, rows_ = 0, tile_columns_ = 0, tile_rows_ = 0;
  std::vector<Tile> tiles_;
};

}  // namespace copse
