#include "tools/bvfit/draw.h"

#include "lib/analysis/volumes/certify.h"
#include "lib/analysis/volumes/volume_mesh.h"
#include "lib/formats/export/export.h"
#include "tools/bvfit/drawn_input.h"
#include "tools/bvfit/hierarchy.h"
#include "tools/picture/mesh_picture.h"

#include <algorithm>
#include <array>
#include <numbers>

#include <fmt/format.h>

namespace copse::bvfit {
namespace {

// As digest 002 (F6.4) draws them: box yellow, capsule red, cylinder green, sphere blue, lozenge lilac; the
// others told apart from these. Dark enough for lines on white.
constexpr std::array<const char*, k_volume_kinds> k_colours{"#6b7280", "#1d6fd1", "#b98a00", "#d02c2c",
                                                            "#1c8a3c", "#9a4fd0", "#0c8a80", "#a0562a"};

Float3 linear_colour(VolumeKind kind) {
  const char* hex = k_colours[static_cast<std::size_t>(kind)];
  Float3 c;
  for (int i = 0; i < 3; ++i) {
    const auto digit = [&](int at) { return hex[at] <= '9' ? hex[at] - '0' : hex[at] - 'a' + 10; };
    const double s = (16 * digit(1 + 2 * i) + digit(2 + 2 * i)) / 255.0;
    c[i] = static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
  }
  return c;
}

void add_volume(Mesh& mesh, const FittedVolume& v, const std::string& set) {
  const VolumeMesh drawn = volume_mesh(to_double(v.volume));
  if (drawn.triangles.empty()) return;
  Material material;
  material.name = fmt::format("{} {}", name_of(v.method.kind), v.method.name);
  material.diffuse = linear_colour(v.method.kind);
  material.alpha = 0.25f;
  material.double_sided = true;
  const auto part = static_cast<std::uint32_t>(mesh.parts.size());
  mesh.parts.push_back(
      {fmt::format("{} {}", set, material.name), "", static_cast<std::uint32_t>(mesh.materials.size())});
  mesh.materials.push_back(std::move(material));
  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), drawn.positions.begin(), drawn.positions.end());
  constexpr Triangle k_without{k_none, k_none, k_none};
  for (const Triangle& t : drawn.triangles) {
    mesh.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
    mesh.part_of.push_back(part);
    if (!mesh.texcoord_triangles.empty()) mesh.texcoord_triangles.push_back(k_without);
    if (!mesh.normal_triangles.empty()) mesh.normal_triangles.push_back(k_without);
  }
}

// --- outlines
// ------------------------------------------------------------------------------------------------

struct Point2 {
  double x = 0, y = 0;
};
double turn(const Point2& a, const Point2& b, const Point2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Volumes are convex: their outline is the hull of their drawn vertices (monotone chain).
std::vector<Point2> outline(std::vector<Point2> points) {
  std::sort(points.begin(), points.end(),
            [](const Point2& a, const Point2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<Point2> hull;
  for (const bool back : {false, true}) {
    const std::size_t start = hull.size();
    for (const Point2& p : points) {
      while (hull.size() >= start + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    if (!back) std::reverse(points.begin(), points.end());
  }
  return hull;
}

std::string outline_svg(const FittedVolume& v, const OrthographicView& view, double fill, int steps = 24) {
  std::vector<Point2> points;
  for (const Double3& p : volume_mesh(to_double(v.volume), steps).positions) {
    const Double3 q = view.project(p);
    points.push_back({q.x, q.y});
  }
  if (points.size() < 2) return "";
  std::string path;
  for (const Point2& p : outline(std::move(points)))
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", p.x, p.y);
  return fmt::format(R"(<path d="{}Z" stroke="{}" fill="{}" fill-opacity="{}"><title>{} {}</title></path>)",
                     path, k_colours[static_cast<std::size_t>(v.method.kind)],
                     k_colours[static_cast<std::size_t>(v.method.kind)], fill, name_of(v.method.kind),
                     v.method.name);
}

// The smallest of each kind, largest first, so that small ones are drawn on top.
std::vector<const FittedVolume*> smallest_of_each(const SetFit& set) {
  std::vector<const FittedVolume*> out;
  for (const FittedVolume& v : set.volumes) {
    const auto same = std::find_if(out.begin(), out.end(),
                                   [&](const FittedVolume* o) { return o->method.kind == v.method.kind; });
    if (same == out.end()) {
      out.push_back(&v);
    } else if (v.measures.volume < (*same)->measures.volume) {
      *same = &v;
    }
  }
  std::stable_sort(out.begin(), out.end(), [](const FittedVolume* a, const FittedVolume* b) {
    return a->measures.volume > b->measures.volume;
  });
  return out;
}

std::string legend_svg(const std::vector<const FittedVolume*>& volumes) {
  // Outlines run below it.
  std::string svg = fmt::format(
      R"(<rect x="6" y="6" width="140" height="{}" rx="4" stroke="none" fill="#f6f6f2" fill-opacity="0.85"/>)",
      19 * volumes.size() + 6);
  double y = 22;
  for (auto v = volumes.rbegin(); v != volumes.rend(); ++v, y += 19) {
    svg += fmt::format(R"(<rect x="14" y="{}" width="14" height="10" rx="2" stroke="none" fill="{}"/>)",
                       y - 9, k_colours[static_cast<std::size_t>((*v)->method.kind)]);
    svg += fmt::format(
        R"(<text x="35" y="{}" stroke="none" fill="#333" font-family="system-ui,sans-serif" font-size="13">{} {:.4g}</text>)",
        y, name_of((*v)->method.kind), (*v)->measures.volume);
  }
  return svg;
}

DoubleBox drawn_box(std::span<const FittedVolume* const> volumes) {
  DoubleBox box;
  for (const FittedVolume* v : volumes) {
    for (const Double3& p : volume_mesh(to_double(v->volume), 4).positions) box.grow(p);
  }
  return box;
}

Result<void> add_pictures(const DrawnInput& drawn, const DoubleBox& box, MeshPicture what,
                          std::vector<ReportPicture>& out) {
  const std::string title = what.title;
  what.is_leaf = [&](std::uint32_t t) { return drawn.is_leaf[t]; };
  what.masks = drawn.masks;
  for (const bool side : {false, true}) {
    what.title = title + (side ? ", from the side" : ", from the front");
    auto picture = draw_picture(
        drawn.mesh, frame_box(box, side ? std::numbers::pi / 2 : 0, k_picture_width, k_picture_height), what);
    if (!picture) return std::unexpected(picture.error());
    out.push_back(std::move(*picture));
  }
  return {};
}

}  // namespace

Result<std::string> volumes_glb(const Input& input, std::span<const SetFit> sets, const std::string& name,
                                Context& context) {
  Mesh mesh = mesh_of(input);
  embed_textures(mesh, context);
  for (const SetFit& set : sets) {
    for (std::size_t i = 0; i < set.volumes.size(); ++i) {
      if (sets.size() == 1 || i == set.chosen) add_volume(mesh, set.volumes[i], set.name);
    }
  }
  if (mesh.triangles.empty())
    return refuse(input.name, "there is nothing to draw: a point has no surface", "leave --export-glb out");
  auto files = export_mesh(mesh, ExportFormat::glb, name);
  if (!files) return std::unexpected(files.error());
  return std::move(files->front().bytes);
}

Result<std::vector<ReportPicture>> volume_pictures(const Input& input, std::span<const SetFit> sets,
                                                   Context& context) {
  std::vector<ReportPicture> out;
  if (input.mesh.triangles.empty() || sets.empty()) return out;
  const DrawnInput drawn = drawn_input(input, context);
  const std::vector<const FittedVolume*> volumes = smallest_of_each(sets.front());
  const MeshPicture whole{"Volumes round " + sets.front().name,
                          "The outline of the smallest volume of each type, with its interior volume.",
                          0.9,
                          {},
                          [&](const OrthographicView& view) {
                            std::string svg = R"(<g stroke-width="1.6">)";
                            for (const FittedVolume* v : volumes) svg += outline_svg(*v, view, 0.03);
                            return svg + "</g>" + legend_svg(volumes);
                          }};
  if (auto ok = add_pictures(drawn, drawn_box(volumes), whole, out); !ok) return std::unexpected(ok.error());
  std::vector<const FittedVolume*> chosen;
  for (const SetFit& set : sets) {
    if (is_fine_part(set.part, set.index, set.motion)) chosen.push_back(&set.volumes[set.chosen]);
  }
  if (chosen.size() < 2) return out;
  // Thousands of outlines must not paint the mesh over, nor it them.
  const bool many = chosen.size() > 100;
  const MeshPicture parts{"Volumes of the parts",
                          "The outline of what was chosen for each part.",
                          many ? 0.4 : 0.9,
                          {},
                          [&](const OrthographicView& view) {
                            std::string svg = many ? R"(<g stroke-width="0.8" stroke-opacity="0.6">)"
                                                   : R"(<g stroke-width="0.9">)";
                            for (const FittedVolume* v : chosen)
                              svg += outline_svg(*v, view, many ? 0 : 0.06, many ? 3 : 24);
                            return svg + "</g>";
                          }};
  if (auto ok = add_pictures(drawn, drawn_box(chosen), parts, out); !ok) return std::unexpected(ok.error());
  return out;
}

}  // namespace copse::bvfit
