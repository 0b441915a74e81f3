#include "tools/treedump/text.h"

#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

namespace copse {

std::string count_text(std::uint64_t value) {
  std::string digits = std::to_string(value);
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, 1, ' ');
  return digits;
}

std::string count_text(std::uint64_t value, const char* noun) {
  const std::string_view name(noun);
  if (value == 1) return fmt::format("1 {}", name);
  const auto plural = [&](std::string_view end, std::string_view other) {
    return fmt::format("{} {}{}", count_text(value), name.substr(0, name.size() - end.size()), other);
  };
  if (name.ends_with("leaf")) return plural("leaf", "leaves");
  if (name.ends_with("radius")) return plural("us", "i");
  if (name.ends_with("vertex")) return plural("ex", "ices");
  return plural("", "s");
}

std::string bytes_text(std::uint64_t bytes) {
  static constexpr std::array<const char*, 5> k_units{"B", "kB", "MB", "GB", "TB"};
  if (bytes < 1000) return fmt::format("{} B", bytes);
  auto value = static_cast<double>(bytes);
  std::size_t unit = 0;
  for (; value >= 999.5 && unit + 1 < k_units.size(); ++unit) value /= 1000;
  const int decimals = value < 9.995 ? 2 : value < 99.95 ? 1 : 0;
  return fmt::format("{:.{}f} {}", value, decimals, k_units[unit]);
}

std::string metres_text(double metres) {
  const double size = std::fabs(metres);
  if (size > 0 && size < 1e-6) return fmt::format("{:.3g} m", metres);
  if (size > 0 && size < 0.01) return fmt::format("{:.3g} mm", metres * 1e3);
  return fmt::format("{:.4g} m", metres);
}

std::string share_text(std::uint64_t part, std::uint64_t whole) {
  if (whole == 0) return "";
  return fmt::format("{:.1f} %", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

}  // namespace copse
