#include "lib/formats/import/ply_header.h"

#include "lib/formats/import/text.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace copse {
namespace {

std::optional<PlyType> type_of(std::string_view word) {
  static constexpr std::array<std::pair<std::string_view, PlyType>, 16> k_types{{{"char", PlyType::i8},
                                                                                 {"int8", PlyType::i8},
                                                                                 {"uchar", PlyType::u8},
                                                                                 {"uint8", PlyType::u8},
                                                                                 {"short", PlyType::i16},
                                                                                 {"int16", PlyType::i16},
                                                                                 {"ushort", PlyType::u16},
                                                                                 {"uint16", PlyType::u16},
                                                                                 {"int", PlyType::i32},
                                                                                 {"int32", PlyType::i32},
                                                                                 {"uint", PlyType::u32},
                                                                                 {"uint32", PlyType::u32},
                                                                                 {"float", PlyType::f32},
                                                                                 {"float32", PlyType::f32},
                                                                                 {"double", PlyType::f64},
                                                                                 {"float64", PlyType::f64}}};
  for (const auto& [name, type] : k_types) {
    if (name == word) return type;
  }
  return std::nullopt;
}

constexpr const char* k_remedy = "export the mesh again";

class HeaderReader {
 public:
  HeaderReader(std::string_view text, PlyHeader& out, MeshBuilder& builder)
      : text_(text), out_(out), builder_(builder) {}

  bool read() {
    if (!text_.starts_with("ply")) return builder_.refuse("does not begin with 'ply'", k_remedy);
    const std::size_t first_end = text_.find_first_of("\r\n");
    if (first_end == std::string_view::npos) return cut_off();
    newline_ = text_[first_end] == '\r' && !text_.substr(first_end + 1).starts_with('\n') ? '\r' : '\n';
    std::string_view line;
    next(line);
    if (line != "ply") return refuse("the first line is not 'ply'");
    while (next(line)) {
      const char* p = line.data();
      const char* end = p + line.size();
      const std::string_view word = next_word(p, end);
      if (word == "end_header") return finish();
      if (!statement(word, p, end)) return false;
    }
    return cut_off();
  }

 private:
  bool next(std::string_view& line) {
    const std::size_t end = text_.find(newline_, out_.size);
    if (end == std::string_view::npos) return false;
    line = text_.substr(out_.size, end - out_.size);
    if (line.ends_with('\r')) line.remove_suffix(1);
    out_.size = end + 1;
    ++out_.lines;
    return true;
  }

  bool statement(std::string_view word, const char* p, const char* end) {
    if (word == "format") return format(p, end);
    if (word == "element") return element(p, end);
    if (word == "property") return property(p, end);
    if (word == "comment" && next_word(p, end) == "TextureFile")
      out_.textures.emplace_back(rest_of_line(p, end));
    if (word.empty() || word == "comment" || word == "obj_info") return true;
    return refuse(fmt::format("{} is not known in a PLY header", in_quotes(word)));
  }

  bool format(const char* p, const char* end) {
    const std::string_view name = next_word(p, end);
    const std::string_view version = next_word(p, end);
    if (name == "ascii") {
      out_.format = PlyFormat::ascii;
    } else if (name == "binary_little_endian") {
      out_.format = PlyFormat::little;
    } else if (name == "binary_big_endian") {
      out_.format = PlyFormat::big;
    } else {
      return refuse(fmt::format("the format {} is not known", in_quotes(name)));
    }
    has_format_ = true;
    return version == "1.0" || refuse(fmt::format("PLY version {} is not read", in_quotes(version)));
  }

  bool element(const char* p, const char* end) {
    PlyElement element;
    element.name = std::string(next_word(p, end));
    std::int64_t count = 0;
    if (element.name.empty() || scan_integer(p, end, count) != Scan::good || count < 0)
      return refuse("the element has no name or no count");
    element.count = static_cast<std::uint64_t>(count);
    out_.elements.push_back(std::move(element));
    return true;
  }

  bool property(const char* p, const char* end) {
    if (out_.elements.empty()) return refuse("the property belongs to no element");
    PlyProperty property;
    std::string_view word = next_word(p, end);
    if (word == "list") {
      property.list = true;
      const auto count_type = type_of(next_word(p, end));
      if (!count_type || !is_integer(*count_type)) return refuse("the list has no whole number for a count");
      property.count_type = *count_type;
      word = next_word(p, end);
    }
    const auto type = type_of(word);
    if (!type) return refuse(fmt::format("the type {} is not known", in_quotes(word)));
    property.type = *type;
    property.name = std::string(next_word(p, end));
    if (property.name.empty()) return refuse("the property has no name");
    out_.elements.back().properties.push_back(std::move(property));
    return true;
  }

  bool finish() { return has_format_ || refuse("the header names no format"); }
  bool refuse(const std::string& what) { return builder_.refuse_at({"line", out_.lines}, what, k_remedy); }
  bool cut_off() { return builder_.refuse("ends in the middle of its header", "copy the file again"); }

  std::string_view text_;
  PlyHeader& out_;
  MeshBuilder& builder_;
  char newline_ = '\n';
  bool has_format_ = false;
};

}  // namespace

std::size_t size_of(PlyType type) {
  static constexpr std::array<std::size_t, 8> k_sizes{1, 1, 2, 2, 4, 4, 4, 8};
  return k_sizes[static_cast<std::size_t>(type)];
}

std::uint64_t PlyElement::least_row(PlyFormat format) const {
  std::uint64_t size = 0;
  for (const PlyProperty& property : properties)
    size += format == PlyFormat::ascii ? 2 : size_of(property.list ? property.count_type : property.type);
  return size;
}

bool read_ply_header(std::string_view text, PlyHeader& out, MeshBuilder& builder) {
  return HeaderReader(text, out, builder).read();
}

}  // namespace copse
