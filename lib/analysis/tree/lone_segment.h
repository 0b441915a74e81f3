// A trunk in which no segment was found still needs one: every stored trunk triangle belongs to a segment.
#pragma once

#include "lib/analysis/rings/hierarchy.h"
#include "lib/analysis/surface/trunk_mesh.h"

namespace copse {

// When the trunk has triangles and the hierarchy no segment, adds the plainest one: from the first root (or,
// without any, from the vertex that is farthest from the mean of all) to the vertex that is farthest from
// there, as thick at both ends as the trunk's vertices are far from that line on average. Nothing is claimed
// to be explained by it, and a note says so. True when a segment was added. Linear.
bool add_lone_segment(const TrunkMesh& trunk, Hierarchy& hierarchy);

}  // namespace copse
