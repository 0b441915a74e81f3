#include "tools/treeprep/picture.h"

#include "lib/analysis/measure/raster.h"
#include "lib/formats/import/image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace copse::treeprep {
namespace {

constexpr int k_width = 560, k_height = 640, k_supersampling = 2;

std::string base64(const std::vector<std::uint8_t>& bytes) {
  static const char* k_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t v = bytes[i] << 16;
    if (n > 1) v |= bytes[i + 1] << 8;
    if (n > 2) v |= bytes[i + 2];
    for (std::size_t c = 0; c < 4; ++c) out += c <= n ? k_digits[(v >> (18 - 6 * c)) & 63] : '=';
  }
  return out;
}

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

Image draw_mesh(const Mesh& mesh, const Classification& classes, OrthographicView view, double opacity) {
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
        const Shade c = shade(mesh, t, classes.leaf_of[t] != k_none, view);
        sum.r += c.r, sum.g += c.g, sum.b += c.b, ++hits;
      }
      if (hits == 0) continue;
      std::uint8_t* p = &image.rgba[4 * (static_cast<std::size_t>(y) * k_width + x)];
      p[0] = static_cast<std::uint8_t>(sum.r / hits), p[1] = static_cast<std::uint8_t>(sum.g / hits);
      p[2] = static_cast<std::uint8_t>(sum.b / hits);
      p[3] = static_cast<std::uint8_t>(255 * opacity * hits / (k_supersampling * k_supersampling));
    }
  }
  return image;
}

// One colour a fork order, dark to light, told apart by most colour-blind readers.
const char* order_colour(std::uint32_t order) {
  static constexpr std::array k_colours{"#b3123a", "#e0700c", "#c9a400", "#1f9e62", "#1277c2", "#7b3fbf"};
  return k_colours[std::min<std::size_t>(order, k_colours.size() - 1)];
}

// How many times one leaves a parent branch on the way from the root.
std::vector<std::uint32_t> fork_orders(const Hierarchy& hierarchy) {
  std::vector<std::uint32_t> order(hierarchy.radii.size(), 0);
  for (std::size_t r = 0; r < order.size(); ++r) {
    const std::uint32_t p = hierarchy.radii[r].parent;
    if (p != k_none) order[r] = order[p] + (hierarchy.radii[p].branch != hierarchy.radii[r].branch);
  }
  return order;
}

std::string draw_axes(const Hierarchy& hierarchy, const OrthographicView& view) {
  const std::vector<std::uint32_t> order = fork_orders(hierarchy);
  std::string svg;
  for (std::size_t r = 0; r < hierarchy.radii.size(); ++r) {
    const RadiusNode& node = hierarchy.radii[r];
    const Double3 b = view.project(node.centre);
    if (node.parent != k_none) {
      const Double3 a = view.project(hierarchy.radii[node.parent].centre);
      svg += fmt::format(R"(<line x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}" stroke="{}"{}/>)", a.x, a.y,
                         b.x, b.y, order_colour(order[r]),
                         node.joint ? R"( stroke-dasharray="2 2" stroke-opacity=".6")" : "");
    }
    svg += fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="{}" fill="{}" stroke="none"/>)", b.x, b.y,
                       node.parent == k_none ? "4" : "1.1", order_colour(order[r]));
  }
  return svg;
}

std::string draw_groups(const std::vector<LeafGroup>& groups, const Double3& origin,
                        const OrthographicView& view) {
  std::string svg;
  for (const LeafGroup& g : groups) {
    const Double3 c = view.project(to_double(g.centre) + origin);
    svg += fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="{:.2f}"/>)", c.x, c.y, g.radius / view.pixel);
  }
  return R"(<g fill="#1277c2" fill-opacity=".06" stroke="#1277c2" stroke-opacity=".7">)" + svg + "</g>";
}

template <class Overlay>
Result<std::vector<ReportPicture>> pictures(const Mesh& mesh, const Classification& classes, double opacity,
                                            const std::string& title, const std::string& caption,
                                            const Overlay& overlay) {
  std::vector<ReportPicture> out;
  const DoubleBox box = bounds(mesh);
  for (const bool side : {false, true}) {
    const OrthographicView view = frame_box(box, side ? std::numbers::pi / 2 : 0, k_width, k_height);
    const auto png = encode_png(draw_mesh(mesh, classes, view, opacity));
    if (!png) return std::unexpected(png.error());
    ReportPicture picture{title + (side ? ", from the side" : ", from the front"), caption, ""};
    picture.svg = fmt::format(
        R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0} {1}" width="{0}" height="{1}" role="img" stroke-width="1">)"
        R"(<title>{2}</title><image width="{0}" height="{1}" href="data:image/png;base64,{3}"/>{4}</svg>)",
        k_width, k_height, picture.title, base64(*png), overlay(view));
    out.push_back(std::move(picture));
  }
  return out;
}

}  // namespace

Result<std::vector<ReportPicture>> skeleton_pictures(const Mesh& mesh, const Classification& classes,
                                                     const Hierarchy& hierarchy) {
  return pictures(
      mesh, classes, 0.55, "Skeleton over the mesh",
      "Every recovered segment's axis, coloured by the number of forks from the root; the large dot is a "
      "root, dashed links join tubes that no surface connects.",
      [&](const OrthographicView& view) { return draw_axes(hierarchy, view); });
}

Result<std::vector<ReportPicture>> group_pictures(const Mesh& mesh, const Classification& classes,
                                                  const std::vector<LeafGroup>& groups,
                                                  const Double3& origin) {
  if (groups.empty()) return {};
  return pictures(mesh, classes, 1, "Leaf groups", "The bounding sphere of every leaf group.",
                  [&](const OrthographicView& view) { return draw_groups(groups, origin, view); });
}

}  // namespace copse::treeprep
