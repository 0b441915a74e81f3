// What treedump shows of an .eco.
#pragma once

#include "lib/formats/result.h"

#include <filesystem>
#include <string>

namespace copse {

// Whether the file calls itself an ecosystem; what cannot be opened does not.
bool is_ecosystem(const std::filesystem::path& path);

// For a person; and for a program, with every instance when `arrays`.
Result<std::string> ecosystem_text(const std::filesystem::path& path);
Result<std::string> ecosystem_json(const std::filesystem::path& path, bool arrays);

}  // namespace copse
