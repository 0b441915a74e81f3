#include "tools/treedump/dump.h"
#include "tools/treedump/text.h"
#include "tools/treedump/views.h"

#include <algorithm>

#include <fmt/format.h>

namespace copse {
namespace {

using Bytes = Array<std::uint8_t>;

std::string label(const SectionInfo& section) {
  return fmt::format("{} ({})", section.name, describe_section(section.name));
}

std::string compare(const SectionInfo& section, const Bytes& a, const Bytes& b) {
  if (a.size() != b.size()) {
    return fmt::format("{}: {}, then {}", label(section), bytes_text(a.size()), bytes_text(b.size()));
  }
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.size(); ++i) different += a[i] != b[i] ? 1 : 0;
  if (different == 0) return "";
  return fmt::format("{}: {} of {} bytes differ", label(section), count_text(different),
                     count_text(a.size()));
}

}  // namespace

Result<std::vector<std::string>> diff_sections(const Container& a, const Container& b,
                                               std::span<const std::string_view> except) {
  const auto counts = [&](const SectionInfo& s) {
    return std::find(except.begin(), except.end(), s.name) == except.end();
  };
  std::vector<std::string> lines;
  for (const SectionInfo& first : a.sections()) {
    if (!counts(first)) continue;
    const SectionInfo* second = b.find(first.name);
    if (second == nullptr) {
      lines.push_back(label(first) + ": only in the first file");
      continue;
    }
    const auto bytes_a = a.read(first);
    if (!bytes_a) return std::unexpected(bytes_a.error());
    const auto bytes_b = b.read(*second);
    if (!bytes_b) return std::unexpected(bytes_b.error());
    if (std::string line = compare(first, *bytes_a, *bytes_b); !line.empty())
      lines.push_back(std::move(line));
  }
  for (const SectionInfo& second : b.sections()) {
    if (counts(second) && a.find(second.name) == nullptr) {
      lines.push_back(label(second) + ": only in the second file");
    }
  }
  return lines;
}

}  // namespace copse
