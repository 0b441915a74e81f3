#include "lib/formats/import/mtl.h"

#include "lib/formats/import/companions.h"
#include "lib/formats/import/lines.h"
#include "lib/formats/import/text.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

namespace copse {
namespace {

// Options of a map statement and how many words follow them at most; numbers may be fewer.
struct MapOption {
  std::string_view name;
  int words;
};
constexpr std::array k_map_options{MapOption{"-blendu", 1}, MapOption{"-blendv", 1},  MapOption{"-boost", 1},
                                   MapOption{"-mm", 2},     MapOption{"-o", 3},       MapOption{"-s", 3},
                                   MapOption{"-t", 3},      MapOption{"-texres", 1},  MapOption{"-clamp", 1},
                                   MapOption{"-bm", 1},     MapOption{"-imfchan", 1}, MapOption{"-type", 1},
                                   MapOption{"-cc", 1}};

bool is_number(std::string_view word) {
  double value = 0;
  const char* p = word.data();
  return scan_double(p, word.data() + word.size(), value) == Scan::good;
}

// The file name of a map statement: what remains after its options. Names may hold blanks.
std::string_view map_file(const char* p, const char* end) {
  for (;;) {
    skip_blanks(p, end);
    const char* start = p;
    const std::string_view word = next_word(p, end);
    const auto* option = std::find_if(k_map_options.begin(), k_map_options.end(),
                                      [&](const MapOption& o) { return o.name == word; });
    if (option == k_map_options.end()) return rest_of_line(start, end);
    const bool numbers = option->words > 1;
    for (int i = 0; i < option->words; ++i) {
      const char* before = p;
      const std::string_view argument = next_word(p, end);
      if (numbers && !is_number(argument)) {
        p = before;
        break;
      }
    }
  }
}

class MtlReader {
 public:
  MtlReader(const std::string& name, MaterialTable& table, MeshBuilder& builder)
      : name_(name), table_(table), builder_(builder) {}

  void read(std::string_view text) {
    Lines lines(text, true);
    for (std::string_view line; lines.next(line);) {
      line_ = lines.number();
      const char* p = line.data();
      const char* end = p + line.size();
      const std::string_view word = next_word(p, end);
      if (word == "newmtl") {
        close();
        current_ = table_.define(to_utf8(rest_of_line(p, end)));
        material() = Material{.name = material().name};
        alpha_map_.clear();
      } else if (current_ != k_none) {
        statement(word, p, end);
      }
    }
    close();
  }

 private:
  Material& material() { return builder_.mesh.materials[current_]; }

  void statement(std::string_view word, const char* p, const char* end) {
    if (word == "Ka") {
      colour(p, end, material().ambient);
    } else if (word == "Kd") {
      colour(p, end, material().diffuse);
    } else if (word == "Ks") {
      colour(p, end, material().specular);
    } else if (word == "Ke") {
      colour(p, end, material().emission, 1e6f);
    } else if (word == "Ns") {
      number(p, end, material().shininess, 1e6f);
    } else if (word == "d") {
      const char* before = p;
      if (next_word(p, end) != "-halo") p = before;
      number(p, end, material().alpha, 1);
    } else if (word == "Tr") {
      float transparency = 0;
      if (number(p, end, transparency, 1)) material().alpha = 1 - transparency;
    } else if (word == "map_Kd") {
      const std::string uri = texture_uri(std::string(map_file(p, end)), builder_);
      if (!uri.empty()) material().texture = table_.add_texture(uri);
    } else if (word == "map_d") {
      alpha_map_ = texture_uri(std::string(map_file(p, end)), builder_);
    }
  }

  // A material with an opacity map is drawn with an alpha test, as leaves are.
  void close() {
    if (current_ == k_none || alpha_map_.empty()) return;
    material().alpha_cutoff = 0.5f;
    const std::uint32_t texture = material().texture;
    if (texture == k_none) {
      material().texture = table_.add_texture(alpha_map_);
    } else if (builder_.mesh.textures[texture].uri != alpha_map_) {
      builder_.notes.add(
          "opacity maps left out",
          fmt::format("{}: material {}: the opacity map {} is not the colour map; its alpha is "
                      "taken from the colour map",
                      name_, in_quotes(material().name), in_quotes(alpha_map_)));
    }
    alpha_map_.clear();
  }

  bool number(const char* p, const char* end, float& out, float most) {
    double value = 0;
    if (scan_double(p, end, value) != Scan::good) return warn();
    out = static_cast<float>(std::clamp(value, 0.0, static_cast<double>(most)));
    return true;
  }

  bool colour(const char* p, const char* end, Float3& out, float most = 1) {
    std::array<double, 3> rgb{};
    int read = 0;
    while (read < 3 && scan_double(p, end, rgb[static_cast<std::size_t>(read)]) == Scan::good) ++read;
    if (read == 1) rgb[1] = rgb[2] = rgb[0];  // the format lets g and b default to r
    if (read != 1 && read != 3) return warn();
    const auto channel = [&](std::size_t i) {
      return static_cast<float>(std::clamp(rgb[i], 0.0, static_cast<double>(most)));
    };
    out = {channel(0), channel(1), channel(2)};
    return true;
  }

  bool warn() {
    builder_.notes.add("statements of material libraries left out",
                       fmt::format("{}: line {}: the numbers cannot be read", name_, line_));
    return false;
  }

  const std::string& name_;
  MaterialTable& table_;
  MeshBuilder& builder_;
  std::uint64_t line_ = 0;
  std::uint32_t current_ = k_none;
  std::string alpha_map_;
};

}  // namespace

std::uint32_t MaterialTable::find_or_add(const std::string& name) {
  const auto [it, is_new] = by_name_.try_emplace(name, static_cast<std::uint32_t>(mesh_.materials.size()));
  if (is_new) {
    mesh_.materials.push_back({.name = name});
    defined_.push_back(false);
  }
  return it->second;
}

std::uint32_t MaterialTable::define(const std::string& name) {
  const std::uint32_t material = find_or_add(name);
  defined_[material] = true;
  return material;
}

std::vector<std::uint32_t> MaterialTable::undefined() const {
  std::vector<std::uint32_t> out;
  for (std::uint32_t m = 0; m < defined_.size(); ++m) {
    if (!defined_[m]) out.push_back(m);
  }
  return out;
}

std::uint32_t MaterialTable::add_texture(const std::string& uri) {
  const auto [it, is_new] =
      texture_by_uri_.try_emplace(uri, static_cast<std::uint32_t>(mesh_.textures.size()));
  if (is_new) mesh_.textures.push_back({.uri = uri, .mime = {}, .bytes = {}});
  return it->second;
}

void read_mtl(std::string_view text, const std::string& name, MaterialTable& table, MeshBuilder& builder) {
  MtlReader(name, table, builder).read(text);
}

}  // namespace copse
