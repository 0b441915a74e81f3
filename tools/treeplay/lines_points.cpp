#include "tools/treeplay/lines_points.h"

#include "tools/treeplay/range_owners.h"

#include <algorithm>
#include <cmath>

namespace copse::treeplay {
namespace {

// What a flat colour looks like in the light of the surface shader (shaders_common.cpp), but for the shadow
// map: how much of the sun arrives is taken from the sky that is open towards it. `n`: of a leaf its normal,
// of a line 0, for no single one can stand for it.
Float3 lit(const Float3& albedo, const Float3& sun, const Float4& here, const Float3& n, double front,
           double through) {
  constexpr double k_sun[] = {2.75, 2.4475, 1.98}, k_sky[] = {0.532, 0.665, 0.9025},
                   k_ground[] = {0.098, 0.122, 0.044}, k_filter[] = {1.05, 1.12, 0.5};
  if (sun == Float3{}) return albedo;
  const Double3 open{here.x, here.y, here.z};
  const double towards = std::max(0.0, here.w + dot(open, to_double(sun))) / (0.5 + 0.5 * sun.y),
               arrives = std::clamp(towards * towards, 0.0, 1.0),
               sky = here.w + std::abs(dot(open, to_double(n)));
  Float3 out;
  for (int c = 0; c < 3; ++c) {
    const double ground =
        k_ground[c] * (k_sun[c] * sun.y * 0.55 + k_sky[c]) * 0.5 * std::min(1.0, 2.2 * here.w);
    const double x = albedo[c] * (k_sun[c] * arrives * (0.85 * front + 0.65 * k_filter[c] * through) +
                                  k_sky[c] * sky + ground);
    out[c] = static_cast<float>(x <= 0.5 ? x : 1 - 0.5 * std::exp(1 - 2 * x));
  }
  return out;
}

// Of the cell that holds a point; open sky outside of the grid.
Float4 sky_at(const SkyLight& sky, const Float3& p) {
  std::size_t at = 0, stride = 1;
  for (int a = 0; a < 3; ++a) {
    const double cell = std::floor((p[a] - sky.corner[a]) / sky.cell);
    const auto size = static_cast<double>(sky.size[static_cast<std::size_t>(a)]);
    if (!(cell >= 0 && cell < size)) return {0, 0.5f, 0, 0.5f};
    at += stride * static_cast<std::size_t>(cell);
    stride *= sky.size[static_cast<std::size_t>(a)];
  }
  return sky.cells[at];
}

Tint tint_of(const Float3& linear) {
  Tint out{0, 0, 0, 255};
  for (int c = 0; c < 3; ++c) {
    const double x = std::clamp<double>(linear[c], 0, 1);
    out[static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(
        std::lround(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055)));
  }
  return out;
}

std::uint32_t leaf_material(const Tree& tree, std::size_t leaf) {
  return tree.leaves.materials.empty() ? tree.leaves.material : tree.leaves.materials[leaf];
}

Float3 normal_of(const Tree& tree, std::size_t leaf) {
  const std::size_t t = tree.first_triangle_of_leaf(leaf);
  if (t >= tree.leaves.triangles.size()) return {0, 1, 0};
  const auto& v = tree.leaves.triangles[t].vertex;
  const Double3 a = to_double(tree.leaves.vertices[v[0]]), b = to_double(tree.leaves.vertices[v[1]]),
                c = to_double(tree.leaves.vertices[v[2]]);
  return to_float(normalized(cross(b - a, c - a), {0, 1, 0}));
}

}  // namespace

LinesPoints::LinesPoints(const Tree& tree, const std::vector<DrawRange>& ranges,
                         const std::function<Float3(std::uint32_t, DrawPart)>& colour)
    : trunk_centre_(tree.header.area_density_centre) {
  const std::vector<Double3> centres = absolute_centres(tree);
  for (const auto& [a, b] : tree.trunk.lines) {
    const bool moves = tree.header.kind == TreeKind::sensitive;
    segments_.push_back({.a = moves ? to_float(centres[a]) : tree.trunk.line_vertices[a],
                         .b = moves ? to_float(centres[b]) : tree.trunk.line_vertices[b]});
  }
  diameters_ = tree.trunk.diameters.to_vector();
  groups_ = tree.leaves.groups.to_vector();
  for (const std::uint32_t leaf : leaves_in_order(tree)) {
    leaves_.push_back({tree.leaves.centres.empty() ? Float3{} : tree.leaves.centres[leaf],
                       normal_of(tree, leaf), colour(leaf_material(tree, leaf), DrawPart::leaves)});
  }
  trunk_colour_ = colour(tree.trunk.material, DrawPart::trunk);
  for (const DrawRange& range : ranges)
    if (range.part == DrawPart::trunk) trunk_colour_ = colour(range.material, DrawPart::trunk);
  keys_ = range_owners(tree, ranges);
}

void LinesPoints::take_light(const SkyLight& sky) {
  for (Segment& s : segments_) s.sky = sky_at(sky, (s.a + s.b) * 0.5f);
  for (Leaf& leaf : leaves_) leaf.sky = sky_at(sky, leaf.centre);
}

void LinesPoints::add_lines(const TreeGeometry& geometry, const Double3& eye, const Double3& forward,
                            double pixel, const Float3& sun, Frame& out) const {
  const double depth = dot(to_double(trunk_centre_) - eye, forward);
  const TrunkSelection chosen = select_trunk(diameters_, depth, {.pixel = pixel}, {});
  // The mean of the cosine over the side of a rod that faces the sun, and the other side in the dark.
  constexpr double k_rod = 0.25;
  for (int w = 1; w <= k_widest_line; ++w) {
    for (std::uint32_t i = chosen.first_of(w); i < chosen.end[static_cast<std::size_t>(w)]; ++i) {
      const Segment& s = segments_[i];
      const auto radius = [&](const Float3& p) {
        return static_cast<float>(0.5 * w * pixel * std::max(dot(to_double(p) - eye, forward), 0.0));
      };
      out.lines.push_back(
          {s.a, s.b, radius(s.a), radius(s.b), tint_of(lit(trunk_colour_, sun, s.sky, {}, k_rod, 0))});
    }
  }
  for (std::size_t r = 0; r < geometry.ranges.size(); ++r) {
    const DrawRange& range = geometry.ranges[r];
    out.ranges.push_back({range.part, range.material, static_cast<std::uint32_t>(out.indices.size()), 0});
    if (range.part != DrawPart::trunk) continue;
    const auto first =
        std::lower_bound(keys_[r].begin(), keys_[r].end(), chosen.triangles) - keys_[r].begin();
    out.indices.insert(out.indices.end(), geometry.indices.begin() + range.first_index + 3 * first,
                       geometry.indices.begin() + range.first_index + range.index_count);
    out.ranges.back().index_count = range.index_count - static_cast<std::uint32_t>(3 * first);
  }
}

void LinesPoints::add_leaves(const Double3& eye, const Double3& forward, double pixel, const Float3& sun,
                             std::vector<std::uint32_t>& runs, Frame& out) const {
  const PrimitiveSizes sizes;
  for (const LeafGroup& group : groups_) {
    const double depth = dot(to_double(group.centre) - eye, forward);
    const GroupSelection chosen = select_group(group, depth, {.pixel = pixel}, sizes);
    for (std::uint32_t i = chosen.first_point; i < chosen.end_point; ++i) {
      const Leaf& leaf = leaves_[group.first + i];
      const double facing = dot(to_double(leaf.normal), to_double(sun));
      // A leaf is seen from either side: half of what falls on it, half of what comes through.
      const Float3 light =
          lit(leaf.colour, sun, leaf.sky, leaf.normal, 0.5 * std::abs(facing), 0.5 * std::abs(facing));
      const double away = dot(to_double(leaf.centre) - eye, forward);
      // As large as the square of a point: a disc of the same area.
      const double radius = sizes.point_size * pixel * std::max(away, 0.0) / std::sqrt(3.14159265358979);
      out.points.push_back({leaf.centre, static_cast<float>(radius), tint_of(light)});
    }
    if (chosen.first_leaf < chosen.end_leaf)
      runs.insert(runs.end(), {group.first + chosen.first_leaf, group.first + chosen.end_leaf});
  }
}

void LinesPoints::select(const TreeGeometry& geometry, const Double3& eye, const Double3& forward,
                         double pixel, const Float3& sun, Frame& out) const {
  out.indices.clear(), out.ranges.clear(), out.lines.clear(), out.points.clear();
  add_lines(geometry, eye, forward, pixel, sun, out);
  std::vector<std::uint32_t> runs;
  add_leaves(eye, forward, pixel, sun, runs, out);
  for (std::size_t r = 0; r < geometry.ranges.size(); ++r) {
    const DrawRange& range = geometry.ranges[r];
    if (range.part == DrawPart::trunk) continue;
    out.ranges[r].first_index = static_cast<std::uint32_t>(out.indices.size());
    for (std::size_t i = 0; i + 1 < runs.size(); i += 2) {
      const auto at = [&](std::uint32_t key) {
        return 3 * (std::lower_bound(keys_[r].begin(), keys_[r].end(), key) - keys_[r].begin());
      };
      const auto begin = geometry.indices.begin() + range.first_index;
      out.indices.insert(out.indices.end(), begin + at(runs[i]), begin + at(runs[i + 1]));
    }
    out.ranges[r].index_count = static_cast<std::uint32_t>(out.indices.size()) - out.ranges[r].first_index;
  }
}

}  // namespace copse::treeplay
