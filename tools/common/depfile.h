// Dependency files as make and ninja read them: "outputs: inputs".
#pragma once

#include "lib/formats/result.h"

#include <filesystem>
#include <string>
#include <vector>

namespace copse {

// A rule that makes `targets` out of date when one of `prerequisites` changes, then an empty rule for each
// prerequisite, so that make does not stop when one of them is deleted. Spaces, tabs, '#', '$', '%' and ':'
// are escaped. Refused (usage): a name with a line break, which the syntax cannot hold.
Result<std::string> make_depfile(const std::vector<std::filesystem::path>& targets,
                                 const std::vector<std::filesystem::path>& prerequisites);

}  // namespace copse
