#include "lib/formats/tree/derive_tree.h"

#include "lib/formats/volumes/sphere_contains.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

namespace copse {
namespace {

using Indices = std::vector<std::uint32_t>;

// The step of offsets that are evenly spaced, 0 otherwise.
std::uint32_t even_step(std::span<const std::uint32_t> offsets) {
  if (offsets.size() < 2) return 0;
  const std::uint32_t step = offsets[1] - offsets[0];
  for (std::size_t i = 1; i + 1 < offsets.size(); ++i)
    if (offsets[i + 1] - offsets[i] != step) return 0;
  return step;
}

void make_constant(std::uint32_t& constant, Array<std::uint32_t>& offsets) {
  constant = even_step(offsets);
  if (constant != 0 || (!offsets.empty() && offsets[offsets.size() - 1] == 0)) offsets = {};
}

float next_up(float radius) {
  return std::nextafter(radius, std::numeric_limits<float>::infinity());
}

double area_of(std::span<const Float3> vertices, const CornerTriangle& t) {
  const Double3 a = to_double(vertices[t.vertex[0]]), b = to_double(vertices[t.vertex[1]]),
                c = to_double(vertices[t.vertex[2]]);
  const Double3 n = cross(b - a, c - a);
  return 0.5 * std::sqrt(dot(n, n));
}

float as_mean(double sum, std::size_t n) {
  return n == 0 ? 0
                : static_cast<float>(
                      std::min(sum / static_cast<double>(n), double{std::numeric_limits<float>::max()}));
}

void derive_radii(Tree& tree) {
  make_constant(tree.header.ring_size, tree.hierarchy.first_vector);
  std::vector<Radius> radii = tree.hierarchy.radii.to_vector();
  tree.header.monotone = !radii.empty();
  for (std::uint32_t r = 0; r < radii.size(); ++r) {
    Radius& x = radii[r];
    x.distance = r < tree.header.roots ? 0 : static_cast<float>(length(to_double(x.centre)));
    double farthest = 0;
    const std::size_t first = tree.first_vector_of(r), end = tree.first_vector_of(r + 1);
    for (std::size_t v = first; v < end; ++v)
      farthest = std::max(farthest, length(to_double(tree.hierarchy.vectors[v])));
    x.outer_radius = round_up(farthest);
    for (std::size_t v = first; v < end;)
      if (sphere_contains({}, x.outer_radius, tree.hierarchy.vectors[v]))
        ++v;
      else
        x.outer_radius = next_up(x.outer_radius);
    if (x.flags & Radius::terminal) continue;
    for (std::uint32_t c = x.first_child; c < x.first_child + x.child_count; ++c)
      if (radii[c].diameter > x.diameter) tree.header.monotone = false;
  }
  tree.hierarchy.radii = std::move(radii);
}

void derive_segments(Tree& tree) {
  make_constant(tree.header.segment_factor, tree.trunk.first_triangle);
  const std::vector<Double3> centres = absolute_centres(tree);
  std::vector<float> diameters;
  std::vector<double> lengths;
  double sum = 0;
  for (const auto& [from, to] : tree.trunk.lines) {
    diameters.push_back(std::max(tree.hierarchy.radii[from].diameter, tree.hierarchy.radii[to].diameter));
    lengths.push_back(sum += distance(centres[from], centres[to]));
  }
  tree.trunk.diameters = std::move(diameters);
  tree.trunk.accumulated_lengths = std::move(lengths);
}

void derive_trunk(Tree& tree) {
  TreeHeader& h = tree.header;
  const std::vector<Float3> vertices = trunk_vertices(tree);
  h.trunk_bounds = {};
  for (const Float3& v : vertices) h.trunk_bounds.grow(v);
  double sum = 0;
  Double3 weighted{};
  for (const CornerTriangle& t : tree.trunk.triangles) {
    const double area = area_of(vertices, t);
    sum += area;
    for (const std::uint32_t v : t.vertex) weighted += to_double(vertices[v]) * (area / 3);
  }
  h.mean_trunk_area = as_mean(sum, tree.trunk.triangles.size());
  h.area_density_centre =
      sum > 0 ? to_float(weighted / sum)
              : to_float(to_double(h.trunk_bounds.empty() ? Float3{} : h.trunk_bounds.centre()));
}

// The mean of the distinct vertices of every leaf; and its area, coverage counted.
void derive_leaves(Tree& tree, std::vector<double>& areas) {
  Leaves& l = tree.leaves;
  make_constant(tree.header.leaf_factor, l.first_triangle);
  std::vector<Float3> centres(areas.size());
  Indices seen;
  double total = 0;
  for (std::size_t leaf = 0; leaf < areas.size(); ++leaf) {
    seen.clear();
    const std::size_t first = tree.first_triangle_of_leaf(leaf), end = tree.first_triangle_of_leaf(leaf + 1);
    double area = 0;
    for (std::size_t t = first; t < end; ++t) {
      area += area_of(l.vertices, l.triangles[t]);
      for (const std::uint32_t v : l.triangles[t].vertex) seen.push_back(v);
    }
    std::sort(seen.begin(), seen.end());
    seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
    if (!seen.empty()) {
      const Double3 about = to_double(l.vertices[seen[0]]);
      Double3 sum{};
      for (const std::uint32_t v : seen) sum += to_double(l.vertices[v]) - about;
      centres[leaf] = to_float(about + sum / static_cast<double>(seen.size()));
    }
    const std::uint32_t m = l.materials.empty() ? l.material : l.materials[leaf];
    areas[leaf] = area * (m < tree.materials.size() ? tree.materials[m].alpha_coverage : 1.0f);
    total += areas[leaf];
  }
  l.centres = std::move(centres);
  tree.header.mean_leaf_area = as_mean(total, areas.size());
  tree.header.bounds = tree.header.trunk_bounds;
  for (const Float3& v : l.vertices) tree.header.bounds.grow(v);
}

// Nearest to the group's centre first, ties by number.
Indices order_by_distance(const Tree& tree) {
  Indices order(tree.leaves.centres.size());
  std::iota(order.begin(), order.end(), 0u);
  std::vector<double> away(order.size());
  for (const LeafGroup& g : tree.leaves.groups) {
    for (std::uint32_t i = g.first; i < g.first + g.count; ++i)
      away[i] = length(to_double(tree.leaves.centres[i]) - to_double(g.centre));
    std::sort(
        order.begin() + g.first, order.begin() + g.first + g.count,
        [&](std::uint32_t a, std::uint32_t b) { return away[a] != away[b] ? away[a] < away[b] : a < b; });
  }
  return order;
}

void derive_groups(Tree& tree, const std::vector<double>& areas) {
  Leaves& l = tree.leaves;
  if (tree.header.leaf_order == LeafOrder::group) l.order = order_by_distance(tree);
  std::vector<LeafGroup> groups = l.groups.to_vector();
  for (LeafGroup& g : groups) {
    double farthest = 0, area = 0;
    Indices vertices;
    for (std::uint32_t i = g.first; i < g.first + g.count; ++i) {
      const std::uint32_t leaf = l.order[i];
      area += areas[leaf];
      for (std::size_t t = tree.first_triangle_of_leaf(leaf); t < tree.first_triangle_of_leaf(leaf + 1); ++t)
        for (const std::uint32_t v : l.triangles[t].vertex) vertices.push_back(v);
    }
    for (const std::uint32_t v : vertices)
      farthest = std::max(farthest, distance(to_double(l.vertices[v]), to_double(g.centre)));
    g.radius = round_up(farthest), g.mean_area = as_mean(area, g.count);
    for (std::size_t i = 0; i < vertices.size();)
      if (sphere_contains(g.centre, g.radius, l.vertices[vertices[i]]))
        ++i;
      else
        g.radius = next_up(g.radius);
  }
  l.groups = std::move(groups);
}

// From the last node to the first: what is below a node comes after it.
void derive_group_hierarchy(Tree& tree) {
  std::vector<GroupNode> nodes = tree.leaves.group_hierarchy.to_vector();
  const auto hold = [](GroupNode& node, const Float3& centre, float radius) {
    const double reach = distance(to_double(node.centre), to_double(centre)) + radius;
    node.radius = std::max(node.radius, round_up(reach));
    while (!sphere_contains(node.centre, node.radius, centre, radius)) node.radius = next_up(node.radius);
  };
  for (std::size_t i = nodes.size(); i-- > 0;) {
    nodes[i].radius = 0;
    if (nodes[i].group != k_none) {
      const LeafGroup& g = tree.leaves.groups[nodes[i].group];
      hold(nodes[i], g.centre, g.radius);
    }
    for (std::uint32_t c = static_cast<std::uint32_t>(i) + 1; c < nodes[i].skip; c = nodes[c].skip)
      hold(nodes[i], nodes[c].centre, nodes[c].radius);
  }
  tree.leaves.group_hierarchy = std::move(nodes);
}

}  // namespace

std::vector<std::array<std::uint32_t, 2>> segments_of(const Tree& tree) {
  const Array<Radius>& radii = tree.hierarchy.radii;
  const Indices parent = parents(tree);
  std::vector<std::array<std::uint32_t, 2>> lines;
  for (std::uint32_t r = 0; r < radii.size(); ++r)
    if (parent[r] != k_none && !(radii[r].flags & Radius::joint)) lines.push_back({parent[r], r});
  const auto diameter = [&](const auto& l) { return std::max(radii[l[0]].diameter, radii[l[1]].diameter); };
  std::stable_sort(lines.begin(), lines.end(),
                   [&](const auto& a, const auto& b) { return diameter(a) < diameter(b); });
  return lines;
}

void derive(Tree& tree) {
  derive_radii(tree);
  derive_segments(tree);
  derive_trunk(tree);
  std::vector<double> areas(tree.leaves.first_triangle.empty() ? 0 : tree.leaves.first_triangle.size() - 1);
  derive_leaves(tree, areas);
  derive_groups(tree, areas);
  derive_group_hierarchy(tree);
}

}  // namespace copse
