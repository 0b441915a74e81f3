#include "tools/treedump/json.h"

#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace copse {

void JsonText::new_line() {
  out_ += '\n';
  out_.append(2 * levels_.size(), ' ');
}

// What stands between two values: after a key nothing, else a comma and, in a layout of lines, a line break.
void JsonText::separate() {
  if (std::exchange(after_key_, false) || levels_.empty()) return;
  Level& level = levels_.back();
  if (!level.empty) out_ += ',';
  if (level.layout == lines) {
    new_line();
  } else if (!level.empty) {
    out_ += ' ';
  }
  level.empty = false;
}

void JsonText::open(char bracket, Layout layout) {
  separate();
  out_ += bracket;
  levels_.push_back({.closing = bracket == '{' ? '}' : ']', .layout = layout});
}

void JsonText::close() {
  const Level level = levels_.back();
  levels_.pop_back();
  if (!level.empty && level.layout == lines) new_line();
  out_ += level.closing;
}

void JsonText::key(std::string_view name) {
  separate();
  fmt::format_to(std::back_inserter(out_), "\"{}\": ", name);
  after_key_ = true;
}

void JsonText::value(std::string_view text) {
  separate();
  out_ += nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void JsonText::value(std::uint32_t number) {
  value(std::uint64_t{number});
}

void JsonText::value(std::uint64_t number) {
  separate();
  const fmt::format_int digits(number);
  out_.append(digits.data(), digits.size());
}

void JsonText::value(std::int64_t number) {
  separate();
  const fmt::format_int digits(number);
  out_.append(digits.data(), digits.size());
}

void JsonText::value(float number) {
  if (!std::isfinite(number)) return null();
  separate();
  fmt::format_to(std::back_inserter(out_), "{}", number);
}

void JsonText::value(double number) {
  if (!std::isfinite(number)) return null();
  separate();
  fmt::format_to(std::back_inserter(out_), "{}", number);
}

void JsonText::raw(std::string_view text) {
  separate();
  out_ += text;
}

std::string JsonText::take() {
  out_ += '\n';
  return std::move(out_);
}

}  // namespace copse
