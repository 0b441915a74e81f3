// What the columns of lodbake's tables mean, for the page.
#pragma once

#include "lib/formats/report.h"

#include <vector>

namespace copse::lodbake {

// A table with a line for each column of `tables` that does not speak for itself, in the order in which they
// come.
Table column_meanings(const std::vector<Table>& tables);

}  // namespace copse::lodbake
