// Which format a file has: by its content where that says it, otherwise by its extension.
#pragma once

#include "lib/formats/import/import.h"

#include <cstdint>
#include <span>
#include <string>

namespace copse {

// `bytes` are inflated; `name` may end in ".gz".
MeshFormat detect_format(std::span<const std::uint8_t> bytes, const std::string& name);

// "OBJ", "GLB", ...
const char* format_name(MeshFormat format);

}  // namespace copse
