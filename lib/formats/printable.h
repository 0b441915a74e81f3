// Names and paths as they may be printed: a file's names can hold line breaks and commands to the terminal.
#pragma once

#include <string>
#include <string_view>

namespace copse {

// On one line: control characters (ASCII's, and in UTF-8 U+0080 to U+009F, among them another escape) as \n
// or \x1b. All else, well-formed or not, stays.
std::string printable(std::string_view text);

// The same of text of several lines: line breaks and tabs stay.
std::string printable_lines(std::string_view text);

}  // namespace copse
