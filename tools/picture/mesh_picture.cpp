#include "tools/picture/mesh_picture.h"

#include "lib/formats/import/image.h"
#include "tools/picture/base64.h"

#include <algorithm>
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

Image draw_mesh(const Mesh& mesh, const MeshPicture& what, OrthographicView view) {
  view.width *= k_supersampling, view.height *= k_supersampling, view.pixel /= k_supersampling;
  const Raster raster = rasterize(mesh.positions, mesh.triangles, view);
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
