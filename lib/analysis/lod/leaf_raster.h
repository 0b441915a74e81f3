// leaf_raster: which pixel centres a small triangle covers, in float32, for pictures that are drawn in order
// to count: a leaf of a few pixels, from many sides, again and again.
//
// Where alpha_raster.h (double, large triangles, any picture) spends divisions on each pixel, this spends
// two products: where a row crosses the three edges is known in advance. Of two triangles with one common
// edge that starts at the first corner of both, as the halves of a card, a pixel centre on it belongs to one.
#pragma once

#include "lib/analysis/measure/drawn_mesh.h"
#include "lib/analysis/measure/raster.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace copse {

// A view of a ball as float32: positions are relative to the ball's centre.
struct LeafEye {
  Float3 right, down, toward;  // per pixel; toward: metres
  float x = 0, y = 0;          // where the ball's centre falls
  int width = 0, height = 0;   // of the picture

  LeafEye() = default;
  explicit LeafEye(const OrthographicView& view)
      : right(to_float(view.right / view.pixel)),
        down(to_float(-view.up / view.pixel)),
        toward(to_float(view.toward)),
        x(static_cast<float>(view.width / 2.0)),
        y(static_cast<float>(view.height / 2.0)),
        width(view.width),
        height(view.height) {}
  Float3 project(const Float3& p) const { return {dot(p, right) + x, dot(p, down) + y, dot(p, toward)}; }
};

namespace leaf_raster {

struct Range {
  int first, last;
};

// Rounding by casts: ceil and floor are calls. Of anything, cut to [-1, size].
inline int floored(float v, int size) {
  return static_cast<int>(std::min(std::max(-1.0f, v), static_cast<float>(size)) + 1) - 1;  // NaN: -1
}
inline int raised(float v, int size) {
  const int below = floored(v, size);
  return below + (v > static_cast<float>(below));
}

// An edge: what is above 0 on the inner side of it, at column 0 of a row and a column further.
struct Edge {
  float slope = 0, per = 0;
  explicit Edge(float s) : slope(s), per(s != 0 ? 1 / s : 0) {}

  // Cuts the columns to where start + slope * column is above 0, or 0 when the edge belongs to the triangle.
  template <bool k_inclusive>
  void cut(float start, int size, Range& columns) const {
    const float zero = -start * per;
    if (slope > 0) {
      columns.first = std::max(columns.first, k_inclusive ? raised(zero, size) : floored(zero, size) + 1);
    } else if (slope < 0) {
      columns.last = std::min(columns.last, k_inclusive ? floored(zero, size) : raised(zero, size) - 1);
    } else if (!(k_inclusive ? start >= 0 : start > 0)) {
      columns.last = -1;
    }
  }
};

// What the mask says, most of which needs no wrapping.
inline bool passes(const AlphaMask& mask, float u, float v) {
  const double x = u, y = 1 - double(v);
  if (!(x >= 0 && x < 1 && y >= 0 && y < 1) || mask.opaque.empty()) return mask.passes(u, v);
  const int column = std::min(static_cast<int>(x * mask.width), mask.width - 1),
            row = std::min(static_cast<int>(y * mask.height), mask.height - 1);
  return mask.opaque[static_cast<std::size_t>(row) * static_cast<std::size_t>(mask.width) +
                     static_cast<std::size_t>(column)] != 0;
}

struct All {
  bool operator()(std::size_t) const { return true; }
};

}  // namespace leaf_raster

// Calls see(pixel, depth) for every pixel centre on the triangle that the mask lets through (null: all), row
// by row. Corners as LeafEye projects them; depth grows toward the viewer. Cost: rows and pixels covered.
// `wanted`: pixels that are asked for at all.
template <class See, class Wanted = leaf_raster::All>
void for_each_leaf_pixel(const std::array<Float3, 3>& corners, const std::array<Float2, 3>& texcoords,
                         const AlphaMask* mask, int width, int height, See&& see, const Wanted& wanted = {}) {
  const auto& [a, b, c] = corners;
  const Float3 p = b - a, q = c - a;
  const float area = p.x * q.y - p.y * q.x;
  if (area == 0 || !std::isfinite(area)) return;
  const int top = std::max(leaf_raster::raised(std::min({a.y, b.y, c.y}) - 0.5f, height), 0);
  const int bottom = std::min(leaf_raster::floored(std::max({a.y, b.y, c.y}) - 0.5f, height), height - 1);
  if (top > bottom) return;
  const float side = area > 0 ? 1.0f : -1.0f, whole = std::abs(area), per = 1 / whole;
  const float qx = side * q.x, qy = side * q.y, px = side * p.x, py = side * p.y, dx = 0.5f - a.x;
  const leaf_raster::Edge along_q(qy), along_p(-py), across(py - qy);
  for (int y = top; y <= bottom; ++y) {
    const float dy = static_cast<float>(y) + 0.5f - a.y;
    const float of_b = dx * qy - dy * qx, of_c = dy * px - dx * py;  // twice their areas, at column 0
    leaf_raster::Range columns{0, width - 1};
    along_q.cut<false>(of_b, width, columns), along_p.cut<true>(of_c, width, columns);
    across.cut<true>(whole - of_b - of_c, width, columns);
    const std::size_t row = static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
    for (int x = columns.first; x <= columns.last; ++x) {
      const float v = (of_b + static_cast<float>(x) * qy) * per,
                  w = (of_c - static_cast<float>(x) * py) * per;
      if (!wanted(row + static_cast<std::size_t>(x))) continue;
      if (mask != nullptr) {
        const float u = 1 - v - w;
        if (!leaf_raster::passes(*mask, u * texcoords[0].x + v * texcoords[1].x + w * texcoords[2].x,
                                 u * texcoords[0].y + v * texcoords[1].y + w * texcoords[2].y))
          continue;
      }
      see(row + static_cast<std::size_t>(x), a.z + v * p.z + w * q.z);
    }
  }
}

}  // namespace copse
