// The JSON that a user writes: edited, and checked against the schema.
#pragma once

#include "lib/formats/result.h"
#include "tools/common/document.h"

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace copse::ecogen {

using Json = nlohmann::ordered_json;

// "types[0].count=500": a value that exists, or a new key of an object that exists. What is right of the
// first '=' is JSON, or a text when it is none. Faults are of usage.
Result<void> edit(Json& document, const std::string& assignment);

// JSON Schema calls 10.0 an integer, and so do pages: numbers without a fraction become integers where they
// are exact (up to 2^53).
void make_whole(Json& document);

// Everything the schema says. An error names the place ("types[2].scale.max"), what is wrong, and what is
// allowed; of a key that is unknown, the nearest that is known.
Result<void> validate(const Json& document, const std::string& file);

}  // namespace copse::ecogen
