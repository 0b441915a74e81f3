#include "lib/analysis/lod/limb_leaves.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace copse {
namespace {

struct Leaf {
  Double3 centre;
  double area = 0;
};

Leaf leaf_of(const Tree& tree, std::size_t number) {
  Leaf leaf;
  Double3 sum;
  double corners = 0;
  const std::size_t end = std::min(tree.first_triangle_of_leaf(number + 1), tree.leaves.triangles.size());
  for (std::size_t t = tree.first_triangle_of_leaf(number); t < end; ++t) {
    Double3 at[3];
    for (std::size_t c = 0; c < 3; ++c) {
      at[c] = to_double(tree.leaves.vertices[tree.leaves.triangles[t].vertex[c]]);
      sum = sum + at[c], ++corners;
    }
    leaf.area += 0.5 * length(cross(at[1] - at[0], at[2] - at[0]));
  }
  if (corners > 0) leaf.centre = sum / corners;
  return leaf;
}

std::size_t nearest_ring(const LimbChain& limb, const std::vector<Double3>& centres, const Double3& place) {
  const std::size_t rings = limb.radii.size();
  const auto stride = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(rings))));
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&](std::size_t first, std::size_t end, std::size_t step) {
    for (std::size_t i = first; i < end; i += step) {
      const Double3 apart = centres[limb.radii[i]] - place;
      if (const double square = dot(apart, apart); square < least) least = square, best = i;
    }
  };
  look(0, rings, stride);
  const std::size_t middle = best;
  look(middle - std::min(middle, stride), std::min(rings, middle + stride + 1), 1);
  return best;
}

}  // namespace

std::vector<std::vector<double>> limb_leaves(const Tree& tree, const std::vector<LimbChain>& limbs,
                                             const std::vector<Double3>& centres) {
  std::vector<std::vector<double>> out(limbs.size());
  if (tree.leaves.triangles.empty()) return out;
  for (std::size_t l = 0; l < limbs.size(); ++l) {
    for (const std::uint32_t r : limbs[l].radii) {
      const Radius& radius = tree.hierarchy.radii[r];
      const bool bears = (radius.flags & Radius::terminal) != 0 && radius.child_count > 0;
      if (!bears || radius.first_child >= tree.leaves.groups.size()) continue;
      out[l].resize(limbs[l].radii.size(), 0);
      const LeafGroup& group = tree.leaves.groups[radius.first_child];
      for (std::uint64_t i = group.first;
           i < std::uint64_t{group.first} + group.count && i < tree.leaves.order.size(); ++i) {
        if (tree.leaves.order[i] >= tree.leaf_count()) continue;
        const Leaf leaf = leaf_of(tree, tree.leaves.order[i]);
        out[l][nearest_ring(limbs[l], centres, leaf.centre)] += leaf.area;
      }
    }
  }
  return out;
}

}  // namespace copse
