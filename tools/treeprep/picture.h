// The pictures of treeprep's page: the recovered skeleton over the mesh, and the leaf groups round the
// leaves.
#pragma once

#include "lib/analysis/leaves/classify.h"
#include "lib/analysis/rings/hierarchy.h"
#include "lib/formats/mesh.h"
#include "lib/formats/report.h"
#include "lib/formats/result.h"
#include "lib/formats/tree/tree.h"

#include <vector>

namespace copse::treeprep {

// From the front and from the side: the mesh (trunk brown, leaves green), rasterised, and over it the axis of
// every segment, coloured by how many forks it is away from the root; joints dashed.
Result<std::vector<ReportPicture>> skeleton_pictures(const Mesh& mesh, const Classification& classes,
                                                     const Hierarchy& hierarchy);

// The leaf groups' spheres over the leaves; nothing when there are none. `origin` is the groups'.
Result<std::vector<ReportPicture>> group_pictures(const Mesh& mesh, const Classification& classes,
                                                  const std::vector<LeafGroup>& groups,
                                                  const Double3& origin);

}  // namespace copse::treeprep
