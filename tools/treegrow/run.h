// What treegrow does once its command line is understood.
#pragma once

#include "tools/common/tool.h"
#include "tools/treegrow/options.h"

namespace copse::treegrow {

Result<void> run(const Options& options, Context& context);

}  // namespace copse::treegrow
