#include "lib/formats/import/text.h"

#include <string>

namespace copse {
namespace {

// The decimal exponent of the first significant digit of a number that from_chars found out of range: only
// its sign matters, to tell 1e999 from 1e-999 and from 0.000...(400 zeros)...1.
bool is_tiny(std::string_view number) {
  std::int64_t exponent = 0;
  bool significant = false;
  bool fraction = false;
  std::size_t i = number.starts_with('-') ? 1 : 0;
  for (; i < number.size() && (number[i] == '.' || (number[i] >= '0' && number[i] <= '9')); ++i) {
    if (number[i] == '.') {
      fraction = true;
    } else {
      significant = significant || number[i] != '0';
      if (significant && !fraction) ++exponent;
      if (!significant && fraction) --exponent;
    }
  }
  std::int64_t written = 0;
  if (i + 1 < number.size()) {
    const char* start = number.data() + i + 1;
    if (*start == '+') ++start;
    const auto [stop, error] = std::from_chars(start, number.data() + number.size(), written);
    if (error == std::errc::result_out_of_range) return *start == '-';
  }
  return exponent + written < 0;
}

// The length of the UTF-8 sequence at the front of `text`, 0 when there is none.
std::size_t sequence_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
  }
  const bool overlong = (lead == 0xe0 && byte(1) < 0xa0) || (lead == 0xf0 && byte(1) < 0x90);
  const bool beyond = (lead == 0xed && byte(1) >= 0xa0) || (lead == 0xf4 && byte(1) >= 0x90);
  return overlong || beyond ? 0 : length;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = sequence_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

}  // namespace

Scan scan_double_slow(const char*& p, const char* end, double& value) {
  const char* start = *p == '+' ? p + 1 : p;
  if (start != p && start != end && *start == '-') return Scan::bad;
  const auto [stop, error] = std::from_chars(start, end, value);
  if (error == std::errc::invalid_argument) return Scan::bad;
  if (stop != end && !is_blank(*stop)) {
    // "1.#QNAN" and its kin, which old C libraries print.
    return *stop == '#' ? Scan::not_finite : Scan::bad;
  }
  if (error == std::errc::result_out_of_range) {
    if (!is_tiny({start, static_cast<std::size_t>(stop - start)})) return Scan::not_finite;
    value = 0;
  }
  if (!std::isfinite(value)) return Scan::not_finite;
  p = stop;
  return Scan::good;
}

std::string in_quotes(std::string_view word) {
  std::string out = "'";
  for (const char c : word.substr(0, 40)) out += (c >= 0x20 && c < 0x7f) ? c : '?';
  return out + (word.size() > 40 ? "...'" : "'");
}

std::string to_utf8(std::string_view name) {
  if (is_utf8(name)) return std::string(name);
  std::string out;
  for (const char c : name) {
    const auto u = static_cast<unsigned char>(c);
    if (u < 0x80) {
      out += c;
    } else {
      out += {static_cast<char>(0xc0 | (u >> 6)), static_cast<char>(0x80 | (u & 0x3f))};
    }
  }
  return out;
}

}  // namespace copse
