// Everything between the mesh and the file, in one call: what tests and the fuzzer run, too.
#pragma once

#include "lib/analysis/leaves/classify.h"
#include "lib/analysis/rings/hierarchy.h"
#include "lib/analysis/surface/trunk_mesh.h"
#include "lib/analysis/tree/assemble.h"
#include "tools/common/tool.h"
#include "tools/treeprep/input.h"
#include "tools/treeprep/leaf_stage.h"
#include "tools/treeprep/options.h"
#include "tools/treeprep/parts.h"

namespace copse::treeprep {

struct Analysis {
  Classification classes;
  TrunkMesh trunk;
  Hierarchy hierarchy;
  LeafStage leaves;
  Assembled assembled;
};

// Classifies, welds, recovers the hierarchy, groups the leaves and assembles the tree, a stage of `context`
// each; `input` as read_input() leaves it, of which the textures' statistics are filled in. The tree is sound
// (check_tree.h). Refused are what --strict forbids and patterns that no part is called by.
Result<Analysis> analyse(Input& input, const Options& options, TreeKind kind, const LeftOut& left_out,
                         Context& context);

}  // namespace copse::treeprep
