// What ecogen does with its options.
#pragma once

#include "tools/common/tool.h"
#include "tools/ecogen/options.h"

namespace copse::ecogen {

Result<void> run(const Options& options, Context& context);

}  // namespace copse::ecogen
