#include "tools/bvfit/grouping.h"

#include "lib/analysis/lod/limb_chains.h"

namespace copse::bvfit {
namespace {

// The limb of each radius: its own, or that of the next radius above it that is in one.
std::vector<std::uint32_t> limbs_of_radii(const Tree& tree, std::span<const LimbChain> limbs) {
  std::vector<std::uint32_t> of(tree.radius_count(), k_none);
  for (std::uint32_t l = 0; l < limbs.size(); ++l) {
    // The first radius of a limb that grows from another one is that one's.
    for (const std::uint32_t r : limbs[l].radii) {
      if (of[r] == k_none) of[r] = l;
    }
  }
  const std::vector<std::uint32_t> parent = parents(tree);
  for (std::uint32_t r = 0; r < of.size(); ++r) {
    if (of[r] == k_none && parent[r] != k_none) of[r] = of[parent[r]];
  }
  return of;
}

}  // namespace

std::uint32_t Grouping::group_of(const PartSet& part) const {
  if (part.part == VolumePart::segment) return of_segment[part.index];
  if (part.part == VolumePart::group) return of_leaf_group[part.index];
  return part.part == VolumePart::cell ? of_cells : part.group;
}

Grouping grouping_of_scene(std::span<const SourceGroup> groups) {
  Grouping out;
  for (const SourceGroup& g : groups) out.parents.push_back(g.parent);
  return out;
}

Grouping grouping_of_tree(const Tree& tree) {
  Grouping out;
  const auto add = [&](std::uint32_t parent) {
    out.parents.push_back(parent);
    return static_cast<std::uint32_t>(out.parents.size() - 1);
  };
  const std::vector<LimbChain> limbs = tree.radius_count() > 0 ? limb_chains(tree) : std::vector<LimbChain>();
  for (const LimbChain& limb : limbs) add(limb.parent);
  // What is in no limb.
  out.of_segment.assign(tree.segment_count(), add(k_none));
  out.of_leaf_group.assign(tree.leaves.groups.size(), add(k_none));
  out.of_cells = add(k_none);
  for (std::uint32_t l = 0; l < limbs.size(); ++l) {
    for (const std::uint32_t s : limbs[l].segments) out.of_segment[s] = l;
  }
  const std::vector<std::uint32_t> limb_of = limbs_of_radii(tree, limbs);
  const auto& radii = tree.hierarchy.radii;
  for (std::uint32_t r = 0; r < radii.size(); ++r) {
    const bool bears = (radii[r].flags & Radius::terminal) != 0 && radii[r].child_count == 1 &&
                       radii[r].first_child < out.of_leaf_group.size();
    if (bears && limb_of[r] != k_none) out.of_leaf_group[radii[r].first_child] = limb_of[r];
  }
  return out;
}

}  // namespace copse::bvfit
