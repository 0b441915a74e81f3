// alpha_raster: which pixel centres a triangle covers, and which of them the alpha of its texture lets
// through.
#pragma once

#include "lib/analysis/measure/drawn_mesh.h"
#include "lib/analysis/measure/raster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace copse {

// How things look: their materials and alpha masks, both one a material (masks may be empty).
struct Looks {
  std::span<const Material> materials;
  std::span<const AlphaMask> masks;
};

struct ScreenCorner {
  Double3 at;  // pixels, depth toward the viewer
  Float2 uv{};
};

struct ScreenTriangle {
  std::array<ScreenCorner, 3> corners;
  const AlphaMask* mask = nullptr;  // null: opaque
};

// A triangle of a mesh as `view` sees it.
inline ScreenTriangle on_screen(const DrawnMesh& mesh, const Looks& looks, const OrthographicView& view,
                                std::uint32_t triangle) {
  ScreenTriangle out;
  const std::uint32_t m = mesh.material[triangle];
  if (m < looks.masks.size() && !looks.masks[m].opaque.empty() && !mesh.texcoords.empty())
    out.mask = &looks.masks[m];
  for (int c = 0; c < 3; ++c) {
    out.corners[c].at = view.project(mesh.positions[mesh.triangles[triangle][c]]);
    if (out.mask != nullptr) out.corners[c].uv = mesh.texcoords[mesh.triangles[triangle][c]];
  }
  return out;
}

namespace alpha_raster {

// The pixels whose centres lie in [low, high], cut to [0, size): first > last when there are none.
struct Range {
  int first, last;
};

inline Range centres(double low, double high, int size) {
  if (!(low <= high && low <= size && high >= 0)) return {0, -1};
  // Rounding by casts: ceil and floor are calls. Both values are above -1.
  const double l = std::max(low, 0.0) - 0.5, h = std::min(high, double(size)) - 0.5;
  const int below = static_cast<int>(l), above = static_cast<int>(h);
  return {below + (l > below), above - (h < above)};
}

// The edges of a triangle: no pixel outside is looked at. Divides once an edge, not once a row.
class Edges {
 public:
  explicit Edges(const std::array<ScreenCorner, 3>& t) {
    for (int i = 0; i < 3; ++i) {
      const Double3 &a = t[i].at, &b = t[(i + 1) % 3].at;
      edges_[i] = {a.x, a.y, b.y, a.y != b.y ? (b.x - a.x) / (b.y - a.y) : 0};
    }
  }
  // Where a row at height y crosses the triangle.
  Range crossing(double y, int width) const {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Edge& e : edges_) {
      if ((e.y <= y) == (e.end <= y)) continue;
      const double x = e.x + (y - e.y) * e.slope;
      low = std::min(low, x), high = std::max(high, x);
    }
    return low <= high ? centres(low, high, width) : Range{0, -1};
  }

 private:
  struct Edge {
    double x, y, end, slope;
  };
  std::array<Edge, 3> edges_;
};

}  // namespace alpha_raster

// Calls see(pixel, depth) for every pixel centre on the triangle, row by row, and wants(pixel, depth) before
// its alpha is looked up. `depth` grows toward the viewer. Cost: pixels covered.
template <class Wants, class See>
void for_each_sample(const ScreenTriangle& triangle, int width, int height, Wants&& wants, See&& see) {
  const auto& t = triangle.corners;
  const Double3 &a = t[0].at, &b = t[1].at, &c = t[2].at;
  const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (area == 0 || !std::isfinite(area)) return;
  // Most small triangles lie between the centres.
  const auto rows = alpha_raster::centres(std::min({a.y, b.y, c.y}), std::max({a.y, b.y, c.y}), height);
  if (rows.first > rows.last) return;
  const auto all = alpha_raster::centres(std::min({a.x, b.x, c.x}), std::max({a.x, b.x, c.x}), width);
  if (all.first > all.last) return;
  const double per_area = 1 / area;
  const alpha_raster::Edges edges(t);
  for (int y = rows.first; y <= rows.last; ++y) {
    const double py = y + 0.5;
    const auto columns = edges.crossing(py, width);
    for (int x = columns.first; x <= columns.last; ++x) {
      const double px = x + 0.5;
      const double u = ((b.x - px) * (c.y - py) - (b.y - py) * (c.x - px)) * per_area;
      const double v = ((c.x - px) * (a.y - py) - (c.y - py) * (a.x - px)) * per_area;
      const double w = 1 - u - v;
      const auto depth = static_cast<float>(u * a.z + v * b.z + w * c.z);
      const std::size_t pixel = static_cast<std::size_t>(y) * width + x;
      if (!wants(pixel, depth)) continue;
      if (triangle.mask != nullptr && !triangle.mask->passes(u * t[0].uv.x + v * t[1].uv.x + w * t[2].uv.x,
                                                             u * t[0].uv.y + v * t[1].uv.y + w * t[2].uv.y))
        continue;
      see(pixel, depth);
    }
  }
}

}  // namespace copse
