// What --help prints.
#pragma once

#include "tools/common/tool.h"

#include <string>

namespace copse {

// Usage, positional arguments, options group by group (the common ones last), two or more worked examples.
// No line is longer than `width`, unless a single word is. At least 40 columns are used, at most 110.
std::string help_text(const ToolInfo& info, const CLI::App& app, int width);

// The limits of --limits, one a line, values aligned.
std::string limits_text(const ToolInfo& info);

}  // namespace copse
