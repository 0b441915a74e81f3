#include "lib/formats/tree/check_parts.h"
#include "lib/formats/tree/check_tolerance.h"
#include "lib/formats/tree/scan.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include <fmt/format.h>

namespace copse {
namespace {

// The lines of an .stree: from a parent to its child, each child once, joints and roots never.
bool check_radius_lines(const Check& check) {
  const auto& lines = check.tree.trunk.lines;
  const auto& radii = check.tree.hierarchy.radii;
  const std::vector<std::uint32_t> parent = parents(check.tree);
  std::vector<bool> used(radii.size());
  bool sound = true;
  const auto bad = [&](std::size_t i, const char* kind) {
    check.add("TLIN", i, kind, [&] { return fmt::format("{} to {}", lines[i][0], lines[i][1]); });
    sound = false;
  };
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto [from, to] = lines[i];
    if (parent[to] == k_none || parent[to] != from) {
      bad(i, "a line that does not join a radius to its parent");
    } else if (radii[to].flags & Radius::joint) {
      bad(i, "a line that ends at a joint");
    } else if (used[to]) {
      bad(i, "a second line to the same radius");
    }
    used[to] = true;
  }
  const auto has_line = [&](std::size_t r) {
    return parent[r] != k_none && !(radii[r].flags & Radius::joint);
  };
  for (std::size_t r = 0; r < radii.size(); ++r) {
    if (!used[r] && has_line(r)) {
      check.add("TLIN", Finding::k_no_element, "a radius without its line",
                [&] { return fmt::format("{}", r); });
    }
  }
  return sound;
}

// Diameters are the larger of the two radii's; equal ones stand in the order of their child radii.
void check_radius_diameters(const Check& check) {
  const auto& lines = check.tree.trunk.lines;
  const auto& radii = check.tree.hierarchy.radii;
  const auto& diameters = check.tree.trunk.diameters;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const float wanted = std::max(radii[lines[i][0]].diameter, radii[lines[i][1]].diameter);
    if (diameters[i] != wanted) {
      check.add("TDIA", i, "not the larger diameter of its two radii",
                [&] { return fmt::format("{}, expected {}", diameters[i], wanted); });
    }
    if (i > 0 && diameters[i] == diameters[i - 1] && lines[i][1] < lines[i - 1][1]) {
      check.add("TLIN", i, "segments of equal diameter out of the order of their radii");
    }
  }
}

void check_lengths(const Check& check, const std::vector<Double3>& ends) {
  const auto& lines = check.tree.trunk.lines;
  const auto& sums = check.tree.trunk.accumulated_lengths;
  double reach = 0;
  for (const Double3& e : ends) reach = std::max({reach, std::abs(e.x), std::abs(e.y), std::abs(e.z)});
  double before = 0;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double wanted = distance(ends[lines[i][0]], ends[lines[i][1]]);
    const double tolerance = length_tolerance(wanted, reach) + 4 * k_double_rounding * sums[i];
    if (!(std::abs(sums[i] - before - wanted) <= tolerance)) {
      check.add("TACC", i, "does not grow by its segment's length",
                [&] { return fmt::format("by {}, expected {}", sums[i] - before, wanted); });
    }
    before = sums[i];
  }
}

void check_areas(const Check& check, std::span<const Float3> vertices) {
  const auto& triangles = check.tree.trunk.triangles;
  if (triangles.empty()) return;
  const double reach = largest_coordinate(box_of(vertices));
  Area sum;
  Double3 weighted{};
  for (const CornerTriangle& t : triangles) {
    const Double3 a = to_double(vertices[t.vertex[0]]), b = to_double(vertices[t.vertex[1]]),
                  c = to_double(vertices[t.vertex[2]]);
    const Area area = triangle_area(a, b, c, reach);
    sum += area;
    weighted += (a + b + c) * (area.value / 3);
  }
  const auto n = static_cast<double>(triangles.size());
  const TreeHeader& h = check.head.header;
  if (!mean_matches(h.mean_trunk_area, 1 / n * sum)) {
    check.add("HEAD", Finding::k_no_element, "the mean area of the trunk's triangles is wrong",
              [&] { return fmt::format("{}, expected {}", h.mean_trunk_area, sum.value / n); });
  }
  if (!(sum.value > 0) || sum.more > sum.value / 2) return;  // no area to speak of: the centre is free
  const Double3 centre = weighted / sum.value;
  const double tolerance = length_tolerance(0, reach) + 4 * reach * (sum.more / sum.value) + 1e-9 * reach;
  if (distance(to_double(h.area_density_centre), centre) > tolerance) {
    check.add("HEAD", Finding::k_no_element, "the area-density centre is wrong", [&] {
      return fmt::format("({} {} {}), expected ({} {} {})", h.area_density_centre.x, h.area_density_centre.y,
                         h.area_density_centre.z, centre.x, centre.y, centre.z);
    });
  }
}

// The ends of the lines, when all that they need is there.
std::optional<std::vector<Double3>> line_ends(const Check& check) {
  const Tree& tree = check.tree;
  if (check.sensitive()) {
    if (tree.radius_count() != check.counts().radii) return std::nullopt;
    return absolute_centres(tree);
  }
  if (tree.trunk.line_vertices.size() != check.counts().line_vertices) return std::nullopt;
  std::vector<Double3> ends;
  ends.reserve(tree.trunk.line_vertices.size());
  for (const Float3& v : tree.trunk.line_vertices) ends.push_back(to_double(v));
  return ends;
}

bool check_line_indices(const Check& check) {
  const std::uint32_t limit = check.sensitive() ? check.counts().radii : check.counts().line_vertices;
  const auto& lines = check.tree.trunk.lines;
  if (all_below({reinterpret_cast<const std::uint32_t*>(lines.data()), lines.size() * 2}, limit)) return true;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i][0] < limit && lines[i][1] < limit) continue;
    check.add("TLIN", i, "index out of range",
              [&] { return fmt::format("{} to {} of {}", lines[i][0], lines[i][1], limit); });
  }
  return false;
}

void check_segments(const Check& check, bool hierarchy_is_sound) {
  const Trunk& t = check.tree.trunk;
  bool diameters = check.finite("TDIA", t.diameters) && check.sorted("TDIA", t.diameters);
  if (diameters && !t.diameters.empty() && t.diameters[0] < 0) {
    check.add("TDIA", 0, "negative", [&] { return fmt::format("{}", t.diameters[0]); });
    diameters = false;
  }
  const bool sums =
      check.finite("TACC", t.accumulated_lengths) && check.sorted("TACC", t.accumulated_lengths);
  bool lines = check_line_indices(check);
  if (!lines || t.lines.empty() || !hierarchy_is_sound) return;
  const auto ends = line_ends(check);
  if (!ends) return;
  if (check.sensitive()) lines = check_radius_lines(check);
  if (!lines) return;
  if (diameters && check.sensitive() && !t.diameters.empty()) check_radius_diameters(check);
  if (sums && !t.accumulated_lengths.empty()) check_lengths(check, *ends);
}

}  // namespace

void check_trunk(const Check& check, bool hierarchy_is_sound) {
  const Trunk& t = check.tree.trunk;
  const TreeCounts& c = check.counts();
  const bool corners =
      check.corners("TTRI", t.triangles, c.trunk_vertices, c.trunk_normals, c.trunk_texcoords);
  check.offsets("TFIR", t.first_triangle, c.trunk_triangles);
  check.below("TMAT", t.materials, c.materials, "materials", true);
  check.finite("TNRM", t.normals);
  check.finite("TTEX", t.texcoords);
  const bool line_vertices = check.finite("TLVX", t.line_vertices);
  const bool stored = check.finite("TVTX", t.vertices);
  check_segments(check, hierarchy_is_sound && line_vertices);

  // The surface as it is drawn.
  const bool present =
      check.sensitive()
          ? check.tree.hierarchy.vectors.size() == c.trunk_vertices && check.tree.radius_count() == c.radii &&
                (check.head.header.ring_size != 0 || !check.tree.hierarchy.first_vector.empty())
          : t.vertices.size() == c.trunk_vertices;
  if (!present || !stored || !hierarchy_is_sound || c.trunk_vertices == 0) return;
  const std::vector<Float3> rebuilt = check.sensitive() ? trunk_vertices(check.tree) : std::vector<Float3>();
  const std::span<const Float3> vertices = check.sensitive() ? rebuilt : t.vertices.span();
  const char* section = check.sensitive() ? "RVEC" : "TVTX";
  check.inside(section, vertices, check.head.header.trunk_bounds, "the trunk");
  if (corners) check_areas(check, vertices);
}

}  // namespace copse
