#include "lib/analysis/tree/assemble.h"

#include "lib/analysis/tree/default_materials.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

namespace copse {
namespace {

double largest_coordinate(const DoubleBox& box) {
  double largest = 0;
  for (int i = 0; i < 3; ++i) largest = std::max({largest, std::abs(box.min[i]), std::abs(box.max[i])});
  return largest;
}

float mean(std::span<const double> values) {
  if (values.empty()) return 0;
  return static_cast<float>(std::accumulate(values.begin(), values.end(), 0.0) /
                            static_cast<double>(values.size()));
}

}  // namespace

Double3 choose_origin(const DoubleBox& bounds) {
  if (bounds.empty()) return {};
  // A float32 has 24 bits: at sixteen times its own size from the origin a tree keeps 20 of them.
  if (largest_coordinate(bounds) <= 16 * length(bounds.extent())) return {};
  const Double3 foot{bounds.centre().x, bounds.min.y, bounds.centre().z};
  const Double3 whole{std::round(foot.x), std::round(foot.y), std::round(foot.z)};
  // A tree smaller than a unit, or one whose coordinates have no whole units: the foot itself.
  return distance(whole, foot) < length(bounds.extent()) ? whole : foot;
}

Assembled assemble(const AssembleInput& in, const AssembleOptions& options) {
  TrunkArrays trunk =
      make_trunk_arrays(in.mesh, in.trunk, in.hierarchy, options.kind, in.origin, in.groups.group_of_radius);
  LeafArrays leaves = make_leaf_arrays(in.mesh, in.leaves, in.origin);

  Assembled out;
  out.mixed_materials = leaves.mixed_materials;
  Tree& tree = out.tree;
  TreeHeader& h = tree.header;
  h.kind = options.kind;
  h.origin = in.origin;
  h.trunk_bounds = trunk.bounds;
  h.bounds = trunk.bounds;
  h.bounds.grow(leaves.bounds);
  h.area_density_centre = trunk.area_density_centre;
  h.mean_trunk_area = trunk.mean_area;
  h.mean_leaf_area = mean(in.leaves.areas);
  h.roots = trunk.roots;
  h.ring_size = trunk.ring_size;
  h.segment_factor = trunk.segment_factor;
  h.leaf_factor = leaves.leaf_factor;
  h.unexplained = trunk.unexplained;
  h.leaf_order = options.leaf_order;
  h.monotone = trunk.monotone;
  tree.materials = in.mesh.materials;
  tree.textures = in.mesh.textures;
  tree.trunk = std::move(trunk.trunk);
  tree.hierarchy = std::move(trunk.hierarchy);
  tree.leaves = std::move(leaves.leaves);
  tree.leaves.groups = in.groups.groups;
  tree.leaves.order = in.groups.order;
  tree.leaves.group_hierarchy = in.groups.hierarchy;
  give_default_materials(in.undefined_materials, tree);
  return out;
}

}  // namespace copse
