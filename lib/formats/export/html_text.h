// Text and numbers as a page shows them to a person.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace copse {

// Safe between tags and inside quoted attributes. What is not UTF-8, and control characters that XML forbids,
// become U+FFFD.
std::string escape_html(std::string_view text);

// About `digits` significant digits: "0.0312", "1 250 000", "3.2e-7" written with a superscript; "-" (a dash)
// when not finite. Escaped already.
std::string show_number(double value, int digits = 3);
std::string show_count(std::uint64_t value);     // thousands set apart by narrow spaces
std::string show_seconds(double seconds);        // "12.4 ms", "3.02 s", "4 min 10 s"
std::string show_bytes(std::uint64_t bytes);     // "12.4 MB"; powers of 1000
std::string show_rate(double items_per_second);  // "1.24 M"

}  // namespace copse
