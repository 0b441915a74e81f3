// --strict: refuses what breaks the thesis' model rules.
#pragma once

#include "lib/analysis/leaves/classify.h"
#include "tools/common/tool.h"
#include "tools/treeprep/input.h"

namespace copse::treeprep {

// Every breach is a warning that names its elements; the error that ends the run counts them.
Result<void> strict_stage(const Input& input, const Classification& classes, Context& context);

}  // namespace copse::treeprep
