// Dependency files as make and ninja read them: "outputs: inputs".
#pragma once

#include "lib/formats/result.h"

#include <filesystem>
#include <string>
#include <vector>

namespace copse {

// Whether a name can stand in a dependency file: refused (usage) where it has a line break, which the syntax
// cannot hold.
Result<void> fits_depfile(const std::filesystem::path& path);

// A rule that makes `targets` out of date when one of `prerequisites` changes, then an empty rule for each
// prerequisite, so that make does not stop when one of them is deleted. Spaces, tabs, '#', '$', '%' and ':'
// are escaped. Refused: a name that does not fit.
Result<std::string> make_depfile(const std::vector<std::filesystem::path>& targets,
                                 const std::vector<std::filesystem::path>& prerequisites);

}  // namespace copse
