// leaf_groups: which leaves hang on which end of the trunk (digest 000, sections 1.4, 2.4 and 4.2.3).
//
// A group is all leaves whose centre is nearest to one terminal radius. It is drawn, moved and simplified as
// one, within one sphere that encloses its triangles.
#pragma once

#include "lib/analysis/leaves/leaf_geometry.h"
#include "lib/formats/mesh.h"
#include "lib/formats/tree/tree.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

struct GroupOptions {
  LeafOrder order = LeafOrder::group;
  std::uint64_t seed = 0;        // of LeafOrder::random
  std::uint32_t max_groups = 0;  // 0: no limit
  Double3 origin;                // spheres are stored relative to it
};

struct LeafGroups {
  std::vector<LeafGroup> groups;        // none empty
  std::vector<std::uint32_t> terminal;  // one a group, ascending: index into `terminals`; k_none without any
  std::vector<std::uint32_t> order;     // of the leaves, group after group, each in GroupOptions::order
  std::vector<std::uint32_t> group_of;  // one a leaf
  std::vector<std::uint32_t> of_terminal;  // one a terminal: its group, k_none for none
  std::uint32_t merged = 0;                // groups that max_groups made part of another
};

// Leaves in a tree without trunk are put together by halving their number along the longest axis of their
// centres until at most this many are left.
inline constexpr std::uint32_t k_leaves_of_a_cluster = 32;

// `terminals`: the absolute centres of the terminal radii. Exact: a leaf goes to the nearest one, of several
// at the same distance to the lowest. The spheres are the smallest (minimal_sphere.h), and proven to enclose
// the leaves' vertices both in double and as they are stored, float32(position - origin).
//
// With max_groups, the group of the fewest leaves joins the group whose leaves' mean is nearest to its own,
// until the limit holds; the joined group stays where the larger one is (future work 1 of the thesis).
//
// Order: `group` by distance from the stored sphere's centre, `terminal` from the terminal radius (from the
// sphere's centre where there is none), nearest first, ties by leaf; `random` by a stream of its own for
// every leaf, so that one leaf more leaves the others' order alone. O(n log n).
LeafGroups leaf_groups(const Mesh& mesh, const LeafGeometry& leaves, std::span<const Double3> terminals,
                       const GroupOptions& options);

}  // namespace copse
