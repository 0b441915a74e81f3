// The texts that ecogen carries: schema.json and template.json.
#pragma once

#include <string_view>

namespace copse::ecogen {

extern const std::string_view k_schema;    // what --schema prints and the input is checked against
extern const std::string_view k_template;  // what --new prints

}  // namespace copse::ecogen
