// The levels of detail of a file, for its summary and its JSON.
#pragma once

#include "lib/formats/tree_file/tree_file.h"
#include "tools/treedump/json.h"

#include <string>
#include <utility>
#include <vector>

namespace copse {

// Label and text of each line; none when the file has no levels, or they are damaged.
std::vector<std::pair<std::string, std::string>> level_lines(const TreeFile& file);

// The member "levels": hysteresis, spectra, the discrete levels and the knots of the schedule. Nothing when
// the file has none.
void add_levels(JsonText& json, const TreeFile& file);

// What is wrong with the levels and the foliage cells, one line each.
std::vector<std::string> verify_levels(const TreeFile& file);

}  // namespace copse
