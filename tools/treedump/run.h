#pragma once

#include "tools/common/tool.h"
#include "tools/treedump/options.h"

namespace copse {

Result<void> run_treedump(const DumpOptions& options, Context& context);

}  // namespace copse
