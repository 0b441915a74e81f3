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

// What the JSON library lets pass.
struct JsonFaults {
  std::string twice;  // the first key that stands twice in one object
  bool deep = false;  // more than k_json_levels
};
inline constexpr int k_json_levels = 64;

// Throws what the library throws (nlohmann::json::exception).
nlohmann::ordered_json parse_json(std::string_view text, JsonFaults& faults);

}  // namespace copse
