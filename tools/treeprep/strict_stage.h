// --strict: refuses what breaks the thesis' model rules.
#pragma once

#include "lib/analysis/leaves/classify.h"
#include "lib/analysis/trunk/strict_hierarchy.h"
#include "tools/common/tool.h"
#include "tools/treeprep/input.h"
#include "tools/treeprep/options.h"

namespace copse::treeprep {

// The trunk as the thesis' algorithm reads it. All breaches are printed with all their elements; the error
// that ends the run then names the rules.
Result<StrictTrunk> strict_stage(const Input& input, const Classification& classes, const Options& options,
                                 Context& context);

}  // namespace copse::treeprep
