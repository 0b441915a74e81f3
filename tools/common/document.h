// JSON that a user, or another program, has written.
#pragma once

#include "lib/formats/result.h"

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace copse {

// Refused with line and column: what is no JSON, numbers beyond a double; a key that stands twice in one
// object, more than 64 levels. Comments are passed over.
Result<nlohmann::ordered_json> parse_document(std::string_view text, const std::string& file);

}  // namespace copse
