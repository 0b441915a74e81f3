// A report as one self-contained HTML page: tables, error bars, curves and pictures; no script, no outside
// file.
#pragma once

#include "lib/formats/report.h"

#include <string>

namespace copse {

std::string to_html(const Report& report);

}  // namespace copse
