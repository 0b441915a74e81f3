#include "tools/treeprep/picture.h"

#include "tools/picture/mesh_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace copse::treeprep {
namespace {

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
  // Spheres lie over each other: the more of them, the fainter, or all that is seen is their colour.
  const double faint = std::min(1.0, 40.0 / static_cast<double>(groups.size()));
  return fmt::format(
      R"(<g fill="#1277c2" fill-opacity="{:.3f}" stroke="#1277c2" stroke-opacity="{:.3f}">{}</g>)",
      0.06 * faint, std::max(0.7 * faint, 0.3), svg);
}

Result<std::vector<ReportPicture>> pictures(const Mesh& mesh, const Classification& classes,
                                            MeshPicture what) {
  std::vector<ReportPicture> out;
  const DoubleBox box = bounds(mesh);
  const std::string title = what.title;
  what.is_leaf = [&](std::uint32_t t) { return classes.leaf_of[t] != k_none; };
  for (const bool side : {false, true}) {
    const OrthographicView view =
        frame_box(box, side ? std::numbers::pi / 2 : 0, k_picture_width, k_picture_height);
    what.title = title + (side ? ", from the side" : ", from the front");
    auto picture = draw_picture(mesh, view, what);
    if (!picture) return std::unexpected(picture.error());
    out.push_back(std::move(*picture));
  }
  return out;
}

}  // namespace

Result<std::vector<ReportPicture>> skeleton_pictures(const Mesh& mesh, const Classification& classes,
                                                     const Hierarchy& hierarchy) {
  return pictures(
      mesh, classes,
      {"Skeleton over the mesh",
       "Every recovered segment's axis, coloured by the number of forks from the root; the large dot is a "
       "root, dashed links join tubes that no surface connects.",
       0.55,
       {},
       [&](const OrthographicView& view) { return draw_axes(hierarchy, view); }});
}

Result<std::vector<ReportPicture>> group_pictures(const Mesh& mesh, const Classification& classes,
                                                  const std::vector<LeafGroup>& groups,
                                                  const Double3& origin) {
  if (groups.empty()) return {};
  return pictures(
      mesh, classes,
      {"Leaf groups", "The bounding sphere of every leaf group.", 1, {}, [&](const OrthographicView& view) {
         return draw_groups(groups, origin, view);
       }});
}

}  // namespace copse::treeprep
