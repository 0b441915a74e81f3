// Numbers as a terminal shows them.
#pragma once

#include <cstdint>
#include <string>

namespace copse {

std::string count_text(std::uint64_t value);                      // "1 234 567"
std::string count_text(std::uint64_t value, const char* noun);    // "1 leaf triangle", "2 leaf triangles"
std::string bytes_text(std::uint64_t bytes);                      // "12.4 MB"
std::string metres_text(double metres);                           // "1.23 m", "4.1 mm"
std::string share_text(std::uint64_t part, std::uint64_t whole);  // "12.3 %"

}  // namespace copse
