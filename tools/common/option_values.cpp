#include "tools/common/option_values.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

#include <fmt/format.h>

namespace copse {
namespace {

template <class T>
std::optional<T> parsed(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// `accepts` is asked about finite numbers only.
template <class Accepts>
CLI::Validator number_check(std::string wanted, Accepts accepts) {
  const auto check = [wanted = std::move(wanted), accepts](const std::string& text) -> std::string {
    const auto value = parsed<double>(text);
    if (value && std::isfinite(*value) && accepts(*value)) return {};
    return fmt::format("'{}' is not {}", text, wanted);
  };
  return CLI::Validator(check, "", "");
}

}  // namespace

CLI::Validator number_above(double least) {
  return number_check(fmt::format("a number above {}", least), [=](double v) { return v > least; });
}

CLI::Validator number_from(double least) {
  return number_check(fmt::format("a number of at least {}", least), [=](double v) { return v >= least; });
}

CLI::Validator number_between(double least, double most) {
  return number_check(fmt::format("a number from {} to {}", least, most),
                      [=](double v) { return v >= least && v <= most; });
}

CLI::Validator whole_number_from(std::uint64_t least, std::uint64_t most) {
  const std::string wanted = most == UINT64_MAX ? fmt::format("a whole number of at least {}", least)
                                                : fmt::format("a whole number from {} to {}", least, most);
  const auto check = [=](const std::string& text) -> std::string {
    const auto value = parsed<std::uint64_t>(text);
    if (value && *value >= least && *value <= most) return {};
    return fmt::format("'{}' is not {}", text, wanted);
  };
  return CLI::Validator(check, "", "");
}

}  // namespace copse
