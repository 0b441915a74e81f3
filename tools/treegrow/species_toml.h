// Species as TOML: what --print writes and --params reads, and how the built-in ones are kept.
//
// One table a part: the tree's own parameters first, then [level0] to [level3], [leaves] and [grass]. The
// part of TOML that this needs is understood: comments, tables, and keys with a number, a string or an array
// of numbers. `base = "oak"` begins with a built-in species; what is not named keeps its value.
#pragma once

#include "lib/formats/result.h"
#include "tools/treegrow/species.h"

#include <string>
#include <string_view>

namespace copse::grow {

// Every parameter with its meaning and its range as a comment.
std::string to_toml(const Species& species);

// `file` is for messages. Errors (refused): line, what is wrong with it, what is possible.
Result<Species> species_from_toml(std::string_view text, const std::string& file);

}  // namespace copse::grow
