#include "lib/analysis/measure/raster.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace copse {
namespace {

// The pixels whose centres lie between `low` and `high`, cut to [0, size).
struct Span {
  int first, last;  // inclusive; empty when last < first
};

Span pixel_span(double low, double high, int size) {
  const double first = std::ceil(std::max(low, 0.0) - 0.5),
               last = std::floor(std::min(high, double(size)) - 0.5);
  if (!(first <= last)) return {0, -1};
  return {static_cast<int>(std::max(first, 0.0)), static_cast<int>(std::min(last, size - 1.0))};
}

void draw(const Double3& a, const Double3& b, const Double3& c, std::uint32_t id, Raster& out) {
  const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (area == 0 || !std::isfinite(area)) return;
  const Span rows = pixel_span(std::min({a.y, b.y, c.y}), std::max({a.y, b.y, c.y}), out.height);
  const Span columns = pixel_span(std::min({a.x, b.x, c.x}), std::max({a.x, b.x, c.x}), out.width);
  for (int y = rows.first; y <= rows.last; ++y) {
    for (int x = columns.first; x <= columns.last; ++x) {
      const double px = x + 0.5, py = y + 0.5;
      const double u = ((b.x - px) * (c.y - py) - (b.y - py) * (c.x - px)) / area;
      const double v = ((c.x - px) * (a.y - py) - (c.y - py) * (a.x - px)) / area;
      const double w = 1 - u - v;
      if (u < 0 || v < 0 || w < 0) continue;
      const auto depth = static_cast<float>(u * a.z + v * b.z + w * c.z);
      const std::size_t i = static_cast<std::size_t>(y) * out.width + x;
      if (depth > out.depth[i]) out.depth[i] = depth, out.triangle[i] = id;
    }
  }
}

}  // namespace

OrthographicView frame_box(const DoubleBox& box, double azimuth, int width, int height) {
  OrthographicView view;
  view.right = {std::cos(azimuth), 0, -std::sin(azimuth)};
  view.toward = {std::sin(azimuth), 0, std::cos(azimuth)};
  view.width = width, view.height = height;
  if (box.empty()) return view;
  view.centre = box.centre();
  const Double3 e = box.extent();
  const double across = std::abs(view.right.x) * e.x + std::abs(view.right.z) * e.z;
  view.pixel = 1.04 * std::max(across / width, e.y / height);
  if (!(view.pixel > 0)) view.pixel = 1;
  return view;
}

Raster rasterize(std::span<const Double3> positions, std::span<const Triangle> triangles,
                 const OrthographicView& view) {
  Raster out{view.width, view.height, {}, {}};
  const std::size_t pixels = static_cast<std::size_t>(view.width) * view.height;
  out.triangle.assign(pixels, k_none);
  out.depth.assign(pixels, -std::numeric_limits<float>::infinity());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    draw(view.project(positions[triangles[t][0]]), view.project(positions[triangles[t][1]]),
         view.project(positions[triangles[t][2]]), t, out);
  }
  return out;
}

}  // namespace copse
