#include "tools/picture/mesh_picture.h"

#include "lib/analysis/measure/alpha_raster.h"
#include "lib/formats/import/image.h"
#include "tools/picture/base64.h"

#include <algorithm>
#include <limits>
#include <vector>

#include <fmt/format.h>

namespace copse {
namespace {

constexpr int k_width = k_picture_width, k_height = k_picture_height, k_supersampling = 2;

struct Shade {
  double r, g, b;
};

// Light from the viewer's upper left, softened: the form must be seen, not lit.
Shade shade(const Mesh& mesh, std::uint32_t t, bool leaf, const OrthographicView& view) {
  const Triangle& v = mesh.triangles[t];
  const Double3 a = mesh.positions[v[0]], b = mesh.positions[v[1]], c = mesh.positions[v[2]];
  Double3 n = normalized(cross(b - a, c - a), view.toward);
  if (dot(n, view.toward) < 0) n = -n;
  const Double3 light = normalized(view.toward + view.up * 0.8 - view.right * 0.5);
  const double s = 0.45 + 0.55 * std::max(0.0, dot(n, light));
  const Shade base = leaf ? Shade{126, 170, 96} : Shade{168, 140, 112};
  return {base.r * s, base.g * s, base.b * s};
}

// The mask under a triangle, and where on it its corners are; none where nothing is cut out.
const AlphaMask* mask_of(const Mesh& mesh, std::uint32_t t, const std::vector<AlphaMask>& masks) {
  const std::uint32_t m = mesh.parts[mesh.part_of[t]].material;
  if (m >= masks.size() || masks[m].opaque.empty() || mesh.texcoord_triangles.empty()) return nullptr;
  const Triangle& uv = mesh.texcoord_triangles[t];
  return uv[0] == k_none || uv[1] == k_none || uv[2] == k_none ? nullptr : &masks[m];
}

Raster see(const Mesh& mesh, const std::vector<AlphaMask>& masks, const OrthographicView& view) {
  if (masks.empty()) return rasterize(mesh.positions, mesh.triangles, view);
  Raster out{view.width, view.height, {}, {}};
  const std::size_t pixels = static_cast<std::size_t>(view.width) * view.height;
  out.triangle.assign(pixels, k_none);
  out.depth.assign(pixels, -std::numeric_limits<float>::infinity());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    ScreenTriangle triangle;
    triangle.mask = mask_of(mesh, t, masks);
    for (std::size_t c = 0; c < 3; ++c) {
      triangle.corners[c].at = view.project(mesh.positions[mesh.triangles[t][c]]);
      if (triangle.mask != nullptr) triangle.corners[c].uv = mesh.texcoords[mesh.texcoord_triangles[t][c]];
    }
    for_each_sample(
        triangle, view.width, view.height,
        [&](std::size_t pixel, float depth) { return depth > out.depth[pixel]; },
        [&](std::size_t pixel, float depth) { out.depth[pixel] = depth, out.triangle[pixel] = t; });
  }
  return out;
}

Image draw_mesh(const Mesh& mesh, const MeshPicture& what, OrthographicView view) {
  view.width *= k_supersampling, view.height *= k_supersampling, view.pixel /= k_supersampling;
  const Raster raster = see(mesh, what.masks, view);
  Image image{k_width, k_height, {}, true};
  image.rgba.resize(std::size_t{4} * k_width * k_height);
  for (int y = 0; y < k_height; ++y) {
    for (int x = 0; x < k_width; ++x) {
      Shade sum{0, 0, 0};
      int hits = 0;
      for (int s = 0; s < k_supersampling * k_supersampling; ++s) {
        const int sx = x * k_supersampling + s % k_supersampling,
                  sy = y * k_supersampling + s / k_supersampling;
        const std::uint32_t t = raster.triangle[static_cast<std::size_t>(sy) * raster.width + sx];
        if (t == k_none) continue;
        const Shade c = shade(mesh, t, what.is_leaf && what.is_leaf(t), view);
        sum.r += c.r, sum.g += c.g, sum.b += c.b, ++hits;
      }
      if (hits == 0) continue;
      std::uint8_t* p = &image.rgba[4 * (static_cast<std::size_t>(y) * k_width + x)];
      p[0] = static_cast<std::uint8_t>(sum.r / hits), p[1] = static_cast<std::uint8_t>(sum.g / hits);
      p[2] = static_cast<std::uint8_t>(sum.b / hits);
      p[3] = static_cast<std::uint8_t>(255 * what.opacity * hits / (k_supersampling * k_supersampling));
    }
  }
  return image;
}

}  // namespace

Result<ReportPicture> draw_picture(const Mesh& mesh, const OrthographicView& view, const MeshPicture& what) {
  const auto png = encode_png(draw_mesh(mesh, what, view));
  if (!png) return std::unexpected(png.error());
  ReportPicture picture{what.title, what.caption, ""};
  picture.svg = fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0} {1}" width="{0}" height="{1}" role="img" stroke-width="1">)"
      R"(<title>{2}</title><image width="{0}" height="{1}" href="data:image/png;base64,{3}"/>{4}</svg>)",
      k_width, k_height, picture.title, base64(*png), what.overlay ? what.overlay(view) : "");
  return picture;
}

}  // namespace copse
