#include "lib/formats/import/detect.h"

#include "lib/formats/import/lines.h"
#include "lib/formats/import/text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <string_view>
#include <utility>

namespace copse {
namespace {

MeshFormat by_extension(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (name.ends_with(".gz")) name.resize(name.size() - 3);
  constexpr std::array<std::pair<std::string_view, MeshFormat>, 6> k_extensions{{{".obj", MeshFormat::obj},
                                                                                 {".ply", MeshFormat::ply},
                                                                                 {".off", MeshFormat::off},
                                                                                 {".stl", MeshFormat::stl},
                                                                                 {".gltf", MeshFormat::gltf},
                                                                                 {".glb", MeshFormat::glb}}};
  for (const auto& [extension, format] : k_extensions) {
    if (name.ends_with(extension)) return format;
  }
  return MeshFormat::unknown;
}

// A binary STL has no magic, but its triangle count fixes its size.
bool is_binary_stl(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < 84) return false;
  std::uint32_t triangles = 0;
  std::memcpy(&triangles, bytes.data() + 80, 4);
  return bytes.size() == 84 + std::uint64_t{50} * triangles;
}

bool is_off_header(std::string_view word) {
  const std::size_t at = word.find("OFF");
  return at != std::string_view::npos && at + 3 == word.size() &&
         word.substr(0, at).find_first_not_of("STCN4n") == std::string_view::npos;
}

// The first word that is neither blank nor in a comment.
std::string_view first_word(std::string_view text) {
  Lines lines(text, false);
  for (std::string_view line; lines.next(line);) {
    const char* p = line.data();
    const std::string_view word = next_word(p, p + line.size());
    if (!word.empty() && !word.starts_with('#')) return word;
  }
  return {};
}

bool is_obj_word(std::string_view word) {
  constexpr std::array<std::string_view, 9> k_words{"v", "vt", "vn", "f", "o", "g", "s", "usemtl", "mtllib"};
  return std::find(k_words.begin(), k_words.end(), word) != k_words.end();
}

}  // namespace

MeshFormat detect_format(std::span<const std::uint8_t> bytes, const std::string& name) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.starts_with("glTF")) return MeshFormat::glb;
  if (text.starts_with("ply\n") || text.starts_with("ply\r")) return MeshFormat::ply;
  if (is_binary_stl(bytes)) return MeshFormat::stl;
  const std::string_view word = first_word(text.substr(0, 65536));
  if (is_off_header(word)) return MeshFormat::off;
  if (word.starts_with('{')) return MeshFormat::gltf;
  if (word == "solid") return MeshFormat::stl;
  const MeshFormat named = by_extension(name);
  if (named != MeshFormat::unknown) return named;
  return is_obj_word(word) ? MeshFormat::obj : MeshFormat::unknown;
}

const char* format_name(MeshFormat format) {
  switch (format) {
    case MeshFormat::obj:
      return "OBJ";
    case MeshFormat::ply:
      return "PLY";
    case MeshFormat::off:
      return "OFF";
    case MeshFormat::stl:
      return "STL";
    case MeshFormat::gltf:
      return "glTF";
    case MeshFormat::glb:
      return "GLB";
    case MeshFormat::unknown:
      break;
  }
  return "unknown";
}

}  // namespace copse
