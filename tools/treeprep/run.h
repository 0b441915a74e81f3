// The work of treeprep, stage after stage.
#pragma once

#include "tools/common/tool.h"
#include "tools/treeprep/options.h"

namespace copse::treeprep {

ToolInfo info();

Result<void> run(const Options& options, Context& context);

}  // namespace copse::treeprep
