// The work of treeplay.
#pragma once

#include "tools/common/tool.h"
#include "tools/treeplay/options.h"

namespace copse::treeplay {

ToolInfo info();
Result<void> run(const Options& options, Context& context);

}  // namespace copse::treeplay
