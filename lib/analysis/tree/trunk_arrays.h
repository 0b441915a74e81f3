// The trunk's stored arrays from its recovered hierarchy: breadth-first radii, segments by ascending
// diameter, and the triangles in segment order (digest 000, sections 3.2 and 4.1).
#pragma once

#include "lib/analysis/rings/hierarchy.h"
#include "lib/analysis/surface/trunk_mesh.h"
#include "lib/formats/tree/tree.h"

namespace copse {

struct TrunkArrays {
  Trunk trunk;
  RadiusHierarchy hierarchy;  // of a sensitive tree; the radii are also what a .tree's lines are made of
  FloatBox bounds;
  Float3 area_density_centre;
  float mean_area = 0;
  std::uint32_t roots = 0, ring_size = 0, segment_factor = 0, unexplained = 0;
  bool monotone = false;
  std::vector<std::uint32_t> stored_radius;  // hierarchy.radii's index of each radius of the input
};

// Every trunk triangle is stored exactly once, explained or not: what no cylinder explains goes with the
// segment of the radius that its vertices hang on. Positions are relative to `origin`. Radii are chained with
// error feedback: however deep the hierarchy, an accumulated centre is within one float32 rounding of the
// true one. `group_of_radius`: the leaf group that hangs on each radius of the input, k_none for none; may be
// empty. Cost: O(n log n) in the segments (their sort), linear otherwise. Precondition: if there are
// triangles, at least one radius has a parent and is no joint.
TrunkArrays make_trunk_arrays(const Mesh& mesh, const TrunkMesh& trunk, const Hierarchy& hierarchy,
                              TreeKind kind, const Double3& origin,
                              const std::vector<std::uint32_t>& group_of_radius);

}  // namespace copse
