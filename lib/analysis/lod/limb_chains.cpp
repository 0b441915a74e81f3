#include "lib/analysis/lod/limb_chains.h"

namespace copse {
namespace {

std::vector<std::uint32_t> segments_by_child(const Tree& tree) {
  std::vector<std::uint32_t> segment(tree.radius_count(), k_none);
  for (std::uint32_t s = 0; s < tree.trunk.lines.size(); ++s) segment[tree.trunk.lines[s][1]] = s;
  return segment;
}

}  // namespace

std::vector<LimbChain> limb_chains(const Tree& tree) {
  const Array<Radius>& radii = tree.hierarchy.radii;
  if (radii.empty()) return {};  // the lines of a .tree name points, not radii
  const std::vector<std::uint32_t> segment = segments_by_child(tree), parent = parents(tree);
  std::vector<std::uint32_t> goes_on(radii.size(), k_none);  // the child that continues the limb
  for (std::uint32_t r = 0; r < radii.size(); ++r) {
    if (parent[r] == k_none || segment[r] == k_none) continue;
    std::uint32_t& best = goes_on[parent[r]];
    if (best == k_none || radii[r].diameter > radii[best].diameter) best = r;
  }
  std::vector<LimbChain> limbs;
  std::vector<std::uint32_t> limb_of(radii.size(), k_none);
  // Breadth first: a radius comes after its parent, so the limb that it grows from is there.
  for (std::uint32_t r = 0; r < radii.size(); ++r) {
    const std::uint32_t p = parent[r];
    if (p != k_none && segment[r] != k_none && goes_on[p] == r && limb_of[p] != k_none &&
        limbs[limb_of[p]].radii.back() == p) {
      limb_of[r] = limb_of[p];
      limbs[limb_of[p]].radii.push_back(r);
      limbs[limb_of[p]].segments.push_back(segment[r]);
      continue;
    }
    LimbChain limb{.radii = {}, .segments = {}, .parent = p == k_none ? k_none : limb_of[p]};
    if (segment[r] != k_none && p != k_none) {
      limb.radii = {p, r};
      limb.segments = {segment[r]};
    } else if (goes_on[r] != k_none) {
      limb.radii = {r};
    } else {
      limb_of[r] = limb.parent;
      continue;
    }
    limb_of[r] = static_cast<std::uint32_t>(limbs.size());
    limbs.push_back(std::move(limb));
  }
  return limbs;
}

}  // namespace copse
