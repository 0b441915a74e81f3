#include "lib/analysis/lod/radius_ancestors.h"

namespace copse {

RadiusAncestors::RadiusAncestors(const Tree& tree)
    : parent_(parents(tree)), depth_(parent_.size(), 0), of_group_(tree.leaves.groups.size(), k_none) {
  for (std::uint32_t r = 0; r < parent_.size(); ++r) {
    if (parent_[r] < r) depth_[r] = depth_[parent_[r]] + 1;
    const Radius& radius = tree.hierarchy.radii[r];
    const bool bears = (radius.flags & Radius::terminal) != 0 && radius.child_count == 1;
    if (bears && radius.first_child < of_group_.size()) of_group_[radius.first_child] = r;
  }
}

std::uint32_t RadiusAncestors::common(std::uint32_t a, std::uint32_t b) const {
  while (a != b) {
    if (a >= parent_.size() || b >= parent_.size()) return k_none;
    if (depth_[a] < depth_[b])
      b = parent_[b];
    else
      a = parent_[a];
  }
  return a;
}

}  // namespace copse
