#include "lib/formats/import/stl.h"

#include "lib/formats/import/exact_weld.h"
#include "lib/formats/import/lines.h"
#include "lib/formats/import/text.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace copse {
namespace {

constexpr const char* k_export_again = "export the mesh again";
constexpr const char* k_copy_again = "copy the file again: its end is missing";

bool same_word(std::string_view a, std::string_view lower) {
  return a.size() == lower.size() && std::equal(a.begin(), a.end(), lower.begin(), [](char c, char l) {
           return (c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c) == l;
         });
}

bool read_binary(std::span<const std::uint8_t> bytes, MeshBuilder& builder) {
  constexpr std::uint64_t k_header = 84, k_triangle = 50;
  if (bytes.size() < k_header) return builder.refuse("ends in the middle of its header", k_copy_again);
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, 4);
  const std::uint64_t needed = k_header + k_triangle * count;
  if (bytes.size() < needed)
    return builder.refuse(
        fmt::format("has {} bytes, and its {} triangles need {}", bytes.size(), count, needed), k_copy_again);
  if (bytes.size() > needed)
    builder.notes.add("bytes after the end", fmt::format("byte {}: data follow the last triangle", needed));
  ExactWeld weld(builder.mesh.positions);
  builder.reserve(count);
  const std::uint32_t part = builder.part("", "", k_none);
  for (std::uint32_t i = 0; i < count; ++i) {
    std::array<float, 9> numbers;
    std::memcpy(numbers.data(), bytes.data() + k_header + k_triangle * i + 12, sizeof numbers);
    std::array<Corner, 3> corners;
    for (std::size_t c = 0; c < 3; ++c) {
      const Double3 p{numbers[3 * c], numbers[3 * c + 1], numbers[3 * c + 2]};
      if (!is_finite(p)) return builder.refuse_at({"triangle", i}, "a vertex is not finite", k_export_again);
      corners[c].position = weld.index_of(p);
    }
    if (!builder.face(corners, part, {"triangle", i})) return false;
  }
  return true;
}

class TextReader {
 public:
  TextReader(std::string_view text, MeshBuilder& builder)
      : lines_(text, false), builder_(builder), weld_(builder.mesh.positions) {}

  bool read() {
    for (std::string_view line; lines_.next(line);) {
      const char* p = line.data();
      const char* end = p + line.size();
      const std::string_view word = next_word(p, end);
      if (!word.empty() && !statement(word, p, end)) return false;
    }
    builder_.close_group(group_);
    return !inside_ || builder_.refuse("ends before 'endsolid'", k_copy_again);
  }

 private:
  Place place() const { return {"line", lines_.number()}; }
  bool refuse(const std::string& what) { return builder_.refuse_at(place(), what, k_export_again); }

  bool statement(std::string_view word, const char* p, const char* end) {
    if (same_word(word, "vertex")) return vertex(p, end);
    if (same_word(word, "facet") || same_word(word, "outer") || same_word(word, "endfacet")) {
      if (!corners_.empty()) return refuse(fmt::format("{} in the middle of a loop", in_quotes(word)));
      return inside_ || refuse(fmt::format("{} outside a solid", in_quotes(word)));
    }
    if (same_word(word, "endloop")) {
      if (!inside_) return refuse("a loop outside a solid");
      const bool good = builder_.face(corners_, part_, place());
      corners_.clear();
      return good;
    }
    if (same_word(word, "solid")) {
      const std::string name = to_utf8(rest_of_line(p, end));
      part_ = builder_.part(name, "", k_none);
      builder_.close_group(group_);
      group_ = builder_.group(name, k_none);
      inside_ = true;
      return part_ != k_none;
    }
    if (same_word(word, "endsolid")) {
      if (!corners_.empty()) return refuse("the solid ends in the middle of a loop");
      inside_ = false;
      return true;
    }
    return refuse(fmt::format("{} is not known in an STL file", in_quotes(word)));
  }

  bool vertex(const char* p, const char* end) {
    if (!inside_) return refuse("a vertex outside a solid");
    std::array<double, 3> v{};
    for (double& value : v) {
      const Scan scan = scan_double(p, end, value);
      if (scan == Scan::not_finite) return refuse("the vertex is not finite");
      if (scan != Scan::good) return refuse("the vertex is not three numbers");
    }
    corners_.push_back({weld_.index_of({v[0], v[1], v[2]}), k_none, k_none});
    return true;
  }

  Lines lines_;
  MeshBuilder& builder_;
  ExactWeld weld_;
  std::uint32_t part_ = k_none, group_ = k_none;
  bool inside_ = false;
  std::vector<Corner> corners_;
};

// Binary files may begin with "solid" too: text has its next keyword soon, and the size of a binary file fits
// its count.
bool is_text(std::span<const std::uint8_t> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::string_view head = text.substr(0, 4096);
  const std::size_t start = head.find_first_not_of(" \t\r\n");
  if (start == std::string_view::npos || !same_word(head.substr(start, 5), "solid")) return false;
  std::uint32_t count = 0;
  if (bytes.size() >= 84) std::memcpy(&count, bytes.data() + 80, 4);
  if (bytes.size() >= 84 && bytes.size() == 84 + std::uint64_t{50} * count) return false;
  return head.find('\0') == std::string_view::npos;
}

}  // namespace

bool read_stl(std::span<const std::uint8_t> bytes, MeshBuilder& builder) {
  if (!is_text(bytes)) return read_binary(bytes, builder);
  return TextReader({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, builder).read();
}

}  // namespace copse
