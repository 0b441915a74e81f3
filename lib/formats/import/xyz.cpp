#include "lib/formats/import/xyz.h"

#include "lib/formats/import/lines.h"
#include "lib/formats/import/source.h"
#include "lib/formats/import/text.h"

#include <algorithm>

#include <fmt/format.h>

namespace copse {
namespace {

bool is_comment(std::string_view line) {
  const std::size_t start = line.find_first_not_of(" \t");
  return start == std::string_view::npos || line[start] == '#' || line.substr(start).starts_with("//");
}

}  // namespace

Result<std::vector<Double3>> read_xyz(std::span<const std::uint8_t> bytes, const std::string& name) {
  Bytes inflated;
  if (is_gzip(bytes)) {
    auto result = inflate_gzip(bytes, name);
    if (!result) return std::unexpected(result.error());
    inflated = std::move(*result);
    bytes = inflated;
  }
  std::vector<Double3> points;
  Lines lines({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, false);
  std::string_view line;
  std::string blanks;
  while (lines.next(line)) {
    if (is_comment(line)) continue;
    if (line.find_first_of(",;") != std::string_view::npos) {
      blanks = line;
      std::replace_if(
          blanks.begin(), blanks.end(), [](char c) { return c == ',' || c == ';'; }, ' ');
      line = blanks;
    }
    const char *p = line.data(), *end = p + line.size();
    Double3 v;
    for (int i = 0; i < 3; ++i) {
      const char* start = p;
      const Scan scan = scan_double(p, end, v[i]);
      if (scan == Scan::good) continue;
      const std::string what = scan == Scan::none ? fmt::format("{} numbers, three are wanted", i)
                               : scan == Scan::not_finite
                                   ? "is not finite: " + in_quotes(next_word(start, end))
                                   : "is no number: " + in_quotes(next_word(start, end));
      return refuse(name, fmt::format("line {}: {}", lines.number(), what), "write a point a line: x y z");
    }
    points.push_back(v);
  }
  return points;
}

Result<std::vector<Double3>> read_xyz(const std::filesystem::path& path) {
  const Result<Bytes> bytes = open_bytes(path);
  if (!bytes) return std::unexpected(bytes.error());
  return read_xyz(*bytes, path.string());
}

}  // namespace copse
