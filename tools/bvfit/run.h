// The work of bvfit, stage after stage.
#pragma once

#include "tools/bvfit/options.h"
#include "tools/common/tool.h"

namespace copse::bvfit {

ToolInfo info();

Result<void> run(const Options& options, Context& context);

}  // namespace copse::bvfit
