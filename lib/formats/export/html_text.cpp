#include "lib/formats/export/html_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

namespace copse {
namespace {

constexpr std::string_view k_replacement = "\xef\xbf\xbd";
constexpr std::string_view k_thin_space = "\xe2\x80\xaf";
constexpr std::string_view k_minus = "\xe2\x88\x92";
constexpr std::string_view k_dash = "\xe2\x80\x93";

// Bytes of the UTF-8 sequence that begins at `text`, 0 when it is not one.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  const std::size_t length = lead < 0x80   ? 1
                             : lead < 0xc2 ? 0
                             : lead < 0xe0 ? 2
                             : lead < 0xf0 ? 3
                             : lead < 0xf5 ? 4
                                           : 0;
  if (length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
  }
  const unsigned second = length > 2 ? byte(1) : 0;
  const bool overlong = (lead == 0xe0 && second < 0xa0) || (lead == 0xf0 && second < 0x90);
  const bool surrogate = lead == 0xed && second > 0x9f;
  const bool too_large = lead == 0xf4 && second > 0x8f;
  return overlong || surrogate || too_large ? 0 : length;
}

std::string grouped(std::string digits) {
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, k_thin_space);
  return digits;
}

std::string superscript(int exponent) {
  static constexpr std::array<std::string_view, 10> k_digits{"⁰", "¹", "²", "³", "⁴",
                                                             "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out = exponent < 0 ? "⁻" : "";
  for (const char c : std::to_string(std::abs(exponent))) out += k_digits[static_cast<std::size_t>(c - '0')];
  return out;
}

// Trailing zeros behind the point say nothing.
std::string trimmed(std::string text) {
  if (text.find('.') == std::string::npos) return text;
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text;
}

std::string magnitude(double value, int digits) {
  if (value == 0) return "0";
  // Rounded first: 999.96 to three digits is 1000.
  const std::string rounded = fmt::format("{:.{}e}", value, digits - 1);
  const std::size_t e = rounded.find('e');
  const int exponent = std::atoi(rounded.c_str() + e + 1);
  if (exponent < -4 || exponent > 14) {
    const std::string mantissa = trimmed(rounded.substr(0, e));
    return (mantissa == "1" ? "" : mantissa + "·") + "10" + superscript(exponent);
  }
  const std::string text = trimmed(fmt::format("{:.{}f}", value, std::max(digits - 1 - exponent, 0)));
  const std::size_t whole = std::min(text.find('.'), text.size());
  return grouped(text.substr(0, whole)) + text.substr(whole);
}

}  // namespace

std::string escape_html(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const char c = text.front();
    const std::size_t length = utf8_length(text);
    const bool control =
        (static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r') || c == 0x7f;
    if (length == 0 || control) {
      out += k_replacement;
    } else if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else if (c == '\'') {
      out += "&#39;";
    } else {
      out += text.substr(0, length);
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return out;
}

std::string show_number(double value, int digits) {
  if (!std::isfinite(value)) return std::string(k_dash);
  return (std::signbit(value) && value != 0 ? std::string(k_minus) : std::string()) +
         magnitude(std::fabs(value), digits);
}

std::string show_count(std::uint64_t value) {
  return grouped(std::to_string(value));
}

std::string show_seconds(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0) return std::string(k_dash);
  if (seconds == 0) return "0 s";
  if (seconds < 1e-3) return show_number(seconds * 1e6) + " µs";
  if (seconds < 1) return show_number(seconds * 1e3) + " ms";
  if (seconds < 100) return show_number(seconds) + " s";
  const auto whole = static_cast<std::uint64_t>(std::llround(std::fmin(seconds, 1e15)));
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", show_count(whole / 3600), whole / 60 % 60);
}

std::string show_bytes(std::uint64_t bytes) {
  static constexpr std::array<std::string_view, 7> k_units{"B", "kB", "MB", "GB", "TB", "PB", "EB"};
  auto value = static_cast<double>(bytes);
  std::size_t unit = 0;
  for (; value >= 999.5 && unit + 1 < k_units.size(); ++unit) value /= 1000;
  return fmt::format("{} {}", show_number(value), k_units[unit]);
}

std::string show_rate(double items_per_second) {
  static constexpr std::array<std::string_view, 4> k_units{"", " k", " M", " G"};
  double value = items_per_second;
  std::size_t unit = 0;
  for (; value >= 999.5 && unit + 1 < k_units.size(); ++unit) value /= 1000;
  return show_number(value) + std::string(k_units[unit]);
}

}  // namespace copse
