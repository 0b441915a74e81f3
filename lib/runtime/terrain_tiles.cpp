#include "lib/runtime/terrain_tiles.h"

#include "lib/runtime/block_culling.h"

#include <algorithm>
#include <cmath>

namespace copse {
namespace {

// The vertices of one side of a tile at a step: first, first + step, ... and the last one always.
struct Side {
  std::uint32_t first = 0, last = 0, step = 1;
  std::uint32_t count() const { return (last - first + step - 1) / step + 1; }
  std::uint32_t operator[](std::uint32_t i) const { return std::min(first + i * step, last); }
  // The nearest one at or before `at`.
  std::uint32_t at_or_before(std::uint32_t at) const {
    return at == last ? last : first + (at - first) / step * step;
  }
};

Side side_of(std::uint32_t tile, std::uint32_t vertices, std::uint32_t level) {
  const std::uint32_t first = tile * k_tile_cells;
  return {first, std::min(first + k_tile_cells, vertices - 1), std::uint32_t{1} << level};
}

}  // namespace

TerrainTiles::TerrainTiles(const Terrain& terrain) : columns_(terrain.columns), rows_(terrain.rows) {
  if (columns_ < 2 || rows_ < 2) return;
  tile_columns_ = (columns_ - 2) / k_tile_cells + 1;
  tile_rows_ = (rows_ - 2) / k_tile_cells + 1;
  tiles_.resize(std::size_t{tile_columns_} * tile_rows_);
  for (std::uint32_t r = 0; r < tile_rows_; ++r)
    for (std::uint32_t c = 0; c < tile_columns_; ++c)
      measure(terrain, c, r, tiles_[std::size_t{r} * tile_columns_ + c]);
}

namespace {

// The square of the largest gap between the vertices of a tile and its triangles at a step: each vertex
// against the point of the coarse triangle that has its place in the grid. Triangles as of the file: cell
// a b / c d is cut from a to d. `at`: what a vertex has, a place or a height.
template <class At, class Square>
double largest_gap(const Side& x, const Side& z, At at, Square square) {
  double largest = 0;
  for (std::uint32_t k = 0; k + 1 < z.count(); ++k)
    for (std::uint32_t i = 0; i + 1 < x.count(); ++i) {
      const std::uint32_t c0 = x[i], c1 = x[i + 1], r0 = z[k], r1 = z[k + 1];
      const auto a = at(c0, r0), b = at(c1, r0), c = at(c0, r1), d = at(c1, r1);
      const double across = 1.0 / (c1 - c0), down = 1.0 / (r1 - r0);
      for (std::uint32_t r = r0; r <= r1; ++r)
        for (std::uint32_t q = c0; q <= c1; ++q) {
          const double u = (q - c0) * across, v = (r - r0) * down;
          const auto on = u >= v ? a * (1 - u) + b * (u - v) + d * v : a * (1 - v) + c * (v - u) + d * u;
          largest = std::max(largest, square(at(q, r) - on));
        }
    }
  return largest;
}

}  // namespace

void TerrainTiles::measure(const Terrain& terrain, std::uint32_t tile_column, std::uint32_t tile_row,
                           Tile& tile) const {
  const Side fine_x = side_of(tile_column, columns_, 0), fine_z = side_of(tile_row, rows_, 0);
  for (std::uint32_t r = fine_z.first; r <= fine_z.last; ++r)
    for (std::uint32_t c = fine_x.first; c <= fine_x.last; ++c) tile.box.grow(terrain.vertex(c, r));
  double worst = 0;
  for (std::uint32_t level = 1; level < k_terrain_levels; ++level) {
    const Side x = side_of(tile_column, columns_, level), z = side_of(tile_row, rows_, level);
    // On a regular grid places agree but for their heights.
    const auto height = [&](std::uint32_t c, std::uint32_t r) {
      return double{terrain.heights[std::size_t{r} * columns_ + c]};
    };
    const double squared =
        terrain.regular() ? largest_gap(x, z, height, [](double gap) { return gap * gap; })
                          : largest_gap(
                                x, z, [&](std::uint32_t c, std::uint32_t r) { return terrain.vertex(c, r); },
                                [](const Double3& gap) { return dot(gap, gap); });
    worst = std::max(worst, std::sqrt(squared));
    tile.errors[level] = round_up(worst);
  }
}

void TerrainTiles::choose(const Double3& eye, double tolerance) {
  for (Tile& tile : tiles_) {
    const double allowed = tolerance * distance_to(eye, tile.box);
    tile.level = 0;
    while (tolerance > 0 && tile.level + 1 < k_terrain_levels &&
           double{tile.errors[tile.level + 1]} <= allowed)
      ++tile.level;
  }
}

std::uint32_t TerrainTiles::level_at(std::int64_t tile_column, std::int64_t tile_row,
                                     std::uint32_t otherwise) const {
  if (tile_column < 0 || tile_row < 0 || tile_column >= tile_columns_ || tile_row >= tile_rows_)
    return otherwise;
  return tiles_[static_cast<std::size_t>(tile_row) * tile_columns_ + static_cast<std::size_t>(tile_column)]
      .level;
}

void TerrainTiles::append_tile(std::uint32_t tile_column, std::uint32_t tile_row,
                               std::vector<std::uint32_t>& indices) const {
  const std::int64_t tc = tile_column, tr = tile_row;
  const std::uint32_t own = level_at(tc, tr, 0);
  const Side x = side_of(tile_column, columns_, own), z = side_of(tile_row, rows_, own);
  // What the edges towards the neighbours are made of: the coarser of the two.
  const auto edge = [&](std::int64_t c, std::int64_t r, bool along_x) {
    const std::uint32_t level = std::max(own, level_at(c, r, own));
    return along_x ? side_of(tile_column, columns_, level) : side_of(tile_row, rows_, level);
  };
  const Side top = edge(tc, tr - 1, true), bottom = edge(tc, tr + 1, true), left = edge(tc - 1, tr, false),
             right = edge(tc + 1, tr, false);
  const auto vertex = [&](std::uint32_t c, std::uint32_t r) {
    const std::uint32_t column = r == z.first  ? top.at_or_before(c)
                                 : r == z.last ? bottom.at_or_before(c)
                                               : c;
    const std::uint32_t row = c == x.first ? left.at_or_before(r) : c == x.last ? right.at_or_before(r) : r;
    return row * columns_ + column;
  };
  const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a != b && b != c && c != a) indices.insert(indices.end(), {a, b, c});
  };
  for (std::uint32_t k = 0; k + 1 < z.count(); ++k)
    for (std::uint32_t i = 0; i + 1 < x.count(); ++i) {
      const std::uint32_t a = vertex(x[i], z[k]), b = vertex(x[i + 1], z[k]), c = vertex(x[i], z[k + 1]),
                          d = vertex(x[i + 1], z[k + 1]);
      triangle(a, c, d), triangle(a, d, b);
    }
}

void TerrainTiles::append(const Frustum& frustum, const Double3& eye,
                          std::vector<std::uint32_t>& indices) const {
  for (std::uint32_t r = 0; r < tile_rows_; ++r)
    for (std::uint32_t c = 0; c < tile_columns_; ++c)
      if (classify(frustum, eye, tiles_[std::size_t{r} * tile_columns_ + c].box) != Visibility::outside)
        append_tile(c, r, indices);
}

void TerrainTiles::append_border(std::vector<std::uint32_t>& vertices) const {
  if (tiles_.empty()) return;
  // All vertices of one side of a tile but the last, which begins the next one.
  const auto along = [&](const Side& s, bool forward, auto&& vertex) {
    for (std::uint32_t i = 0; i + 1 < s.count(); ++i)
      vertices.push_back(vertex(s[forward ? i : s.count() - 1 - i]));
  };
  const std::uint32_t right = columns_ - 1, bottom = rows_ - 1;
  for (std::uint32_t t = 0; t < tile_columns_; ++t)
    along(side_of(t, columns_, level_at(t, 0, 0)), true, [&](std::uint32_t c) { return c; });
  for (std::uint32_t t = 0; t < tile_rows_; ++t)
    along(side_of(t, rows_, level_at(tile_columns_ - 1, t, 0)), true,
          [&](std::uint32_t r) { return r * columns_ + right; });
  for (std::uint32_t t = tile_columns_; t-- > 0;)
    along(side_of(t, columns_, level_at(t, tile_rows_ - 1, 0)), false,
          [&](std::uint32_t c) { return bottom * columns_ + c; });
  for (std::uint32_t t = tile_rows_; t-- > 0;)
    along(side_of(t, rows_, level_at(0, t, 0)), false, [&](std::uint32_t r) { return r * columns_; });
}

}  // namespace copse
