// The leaves of treeprep: texture statistics, centres and areas, groups and the spheres over them.
#pragma once

#include "lib/analysis/leaves/classify.h"
#include "lib/analysis/leaves/leaf_geometry.h"
#include "lib/analysis/rings/hierarchy.h"
#include "lib/analysis/tree/assemble.h"
#include "tools/common/tool.h"
#include "tools/treeprep/input.h"
#include "tools/treeprep/options.h"
#include "tools/treeprep/parts.h"

namespace copse::treeprep {

struct LeafStage {
  LeafGeometry geometry;
  TreeGroups groups;
  std::uint32_t merged = 0;  // groups that --max-leaf-groups made part of another
};

// Groups the leaves round the terminal radii and fits the hierarchy of spheres, as far as they are not left
// out.
LeafStage leaf_stage(const Input& input, const Classification& classes, const Hierarchy& hierarchy,
                     const Double3& origin, const Options& options, const LeftOut& left_out,
                     Context& context);

}  // namespace copse::treeprep
