// Scanning of text formats, independent of the locale: logical lines, words and numbers.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <system_error>

namespace copse {

constexpr bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

inline void skip_blanks(const char*& p, const char* end) {
  while (p != end && is_blank(*p)) ++p;
}

// The next word of a line, empty at its end.
inline std::string_view next_word(const char*& p, const char* end) {
  skip_blanks(p, end);
  const char* start = p;
  while (p != end && !is_blank(*p)) ++p;
  return {start, static_cast<std::size_t>(p - start)};
}

// The rest of a line without the blanks round it.
inline std::string_view rest_of_line(const char* p, const char* end) {
  skip_blanks(p, end);
  while (end != p && is_blank(end[-1])) --end;
  return {p, static_cast<std::size_t>(end - p)};
}

enum class Scan { good, none, bad, not_finite };

// Reads a number as C writes it, with an optional plus sign. Must end at a blank or the end. A magnitude too
// small for a double is zero; one too large, an infinity or a NaN is `not_finite`.
Scan scan_double_slow(const char*& p, const char* end, double& value);

inline Scan scan_double(const char*& p, const char* end, double& value) {
  skip_blanks(p, end);
  if (p == end) return Scan::none;
  const auto [stop, error] = std::from_chars(p, end, value);
  if (error == std::errc() && (stop == end || is_blank(*stop)) && std::isfinite(value)) {
    p = stop;
    return Scan::good;
  }
  return scan_double_slow(p, end, value);
}

// A whole number; `bad` when it does not fit.
inline Scan scan_integer(const char*& p, const char* end, std::int64_t& value) {
  skip_blanks(p, end);
  if (p == end) return Scan::none;
  const char* start = *p == '+' ? p + 1 : p;
  const auto [stop, error] = std::from_chars(start, end, value);
  if (error != std::errc() || (stop != end && !is_blank(*stop))) return Scan::bad;
  p = stop;
  return Scan::good;
}

// A word for a message: at most 40 bytes of it, what cannot be printed as '?'.
std::string in_quotes(std::string_view word);

// A name from a file as UTF-8: as it is when it is UTF-8, otherwise taken as Latin-1.
std::string to_utf8(std::string_view name);

}  // namespace copse
