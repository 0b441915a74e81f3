// Response files: an argument @FILE stands for the arguments written in FILE.
//
// The rules are those of GCC: arguments are separated by white space; '...' and "..." keep white space; a
// backslash takes the next character as it is, inside quotes too. A response file may name others, whose
// paths, too, are relative to the current folder. After an argument "--" nothing is replaced; write ./@x for
// a file whose name begins with @.
#pragma once

#include "lib/formats/result.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace copse {

inline constexpr int k_response_depth = 16;                   // files that name files
inline constexpr std::size_t k_response_args = 1'000'000;     // arguments in all
inline constexpr std::uint64_t k_response_bytes = 64u << 20;  // of all response files together
inline constexpr std::uint64_t k_config_bytes = 1u << 20;     // of a configuration file

struct ExpandedArguments {
  std::vector<std::string> arguments;
  std::vector<std::filesystem::path> files;  // every response file, in the order of reading
};

// Errors: io when a file cannot be read; usage for an unclosed quote and for what exceeds the limits.
Result<ExpandedArguments> expand_response_files(const std::vector<std::string>& arguments);

// Splits text by the rules above. `name` stands in messages.
Result<std::vector<std::string>> split_arguments(std::string_view text, const std::string& name);

}  // namespace copse
