#include "lib/analysis/leaves/stand_ins.h"

#include "lib/analysis/leaves/glob.h"
#include "lib/analysis/leaves/name_words.h"

#include <algorithm>
#include <array>
#include <map>

namespace copse {
namespace {

constexpr std::array<std::string_view, 5> k_prefixes{"ucx", "ubx", "usp", "ucp", "mcdcx"};
constexpr std::array<std::string_view, 2> k_suffixes{"-colonly", "-convcolonly"};
constexpr std::array<std::string_view, 6> k_words{"collision", "collisions", "collider",
                                                  "colliders", "hitbox",     "hitboxes"};
constexpr std::string_view k_lod = "lod";

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}
std::string lowered(std::string_view text) {
  std::string out(text);
  std::ranges::transform(out, out.begin(), lower);
  return out;
}

// Whether a glob of the user's means what the word says of the name.
bool names_it(std::span<const std::string> globs, std::string_view name, std::string_view word) {
  return std::ranges::any_of(globs, [&](const std::string& glob) {
    return lowered(glob).find(word) != std::string::npos && glob_match(glob, name);
  });
}

// What tells a part, the object's name before the group's.
std::array<std::string_view, 2> names_of(const Part& part) {
  return {part.object, part.group};
}

class Finder {
 public:
  Finder(const Mesh& mesh, std::span<const std::string> kept)
      : mesh_(mesh), kept_(kept), uses_(mesh.parts.size(), 0) {
    for (const std::uint32_t p : mesh.part_of) ++uses_[p];
  }

  std::vector<StandIn> run() {
    find_lowest();
    std::vector<StandIn> found;
    std::size_t gone = 0;
    for (std::uint32_t p = 0; p < mesh_.parts.size(); ++p) {
      if (uses_[p] == 0 || !look_at(p, found)) continue;
      gone += uses_[p];
    }
    if (gone == mesh_.triangles.size()) found.clear();
    return found;
  }

 private:
  void find_lowest() {
    for (std::uint32_t p = 0; p < mesh_.parts.size(); ++p) {
      if (uses_[p] == 0) continue;
      for (const std::string_view name : names_of(mesh_.parts[p])) {
        const auto lod = lod_name(name);
        if (!lod || !hull_word(name).empty()) continue;
        const auto [at, fresh] = lowest_.try_emplace(lod->of, lod->level);
        at->second = std::min(at->second, lod->level);
      }
    }
  }

  bool look_at(std::uint32_t p, std::vector<StandIn>& found) const {
    for (const std::string_view name : names_of(mesh_.parts[p])) {
      const std::string_view word = hull_word(name);
      const auto lod = lod_name(name);
      const bool is_level = lod && word.empty() && lod->level > lowest_.at(lod->of);
      if ((word.empty() && !is_level) || names_it(kept_, name, is_level ? k_lod : word)) continue;
      found.push_back({p, std::string(name), !is_level});
      return true;
    }
    return false;
  }

  const Mesh& mesh_;
  std::span<const std::string> kept_;
  std::vector<std::size_t> uses_;                // one a part: its triangles
  std::map<std::string, std::uint32_t> lowest_;  // level of each name that has some
};

template <class Row>
void keep_rows(std::vector<Row>& rows, std::span<const std::uint32_t> kept) {
  if (rows.empty()) return;
  for (std::size_t i = 0; i < kept.size(); ++i) rows[i] = rows[kept[i]];
  rows.resize(kept.size());
}

}  // namespace

std::string_view hull_word(std::string_view name) {
  const std::string text = lowered(name);
  for (const std::string_view prefix : k_prefixes) {
    if (text.starts_with(prefix) && text.size() > prefix.size() && text[prefix.size()] == '_') return prefix;
  }
  for (const std::string_view suffix : k_suffixes) {
    if (text.ends_with(suffix)) return suffix;
  }
  for (const std::string& word : words_of(name)) {
    const auto at = std::ranges::find(k_words, word);
    if (at != k_words.end()) return *at;
  }
  return {};
}

std::optional<LodName> lod_name(std::string_view name) {
  const std::string text = lowered(name);
  for (std::size_t at = text.find(k_lod); at != std::string::npos; at = text.find(k_lod, at + 1)) {
    const bool begins = at == 0 || !is_letter(name[at - 1]) || (name[at] == 'L' && name[at - 1] >= 'a');
    std::size_t digits = at + k_lod.size();
    if (digits < text.size() && (text[digits] == '_' || text[digits] == '-' || text[digits] == ' ')) ++digits;
    std::size_t end = digits;
    while (end < text.size() && is_digit(text[end])) ++end;
    constexpr std::size_t k_most_digits = 2;  // more are a year or a number of the asset
    if (!begins || end == digits || end - digits > k_most_digits) continue;
    return LodName{text.substr(0, at),
                   static_cast<std::uint32_t>(std::stoul(text.substr(digits, end - digits)))};
  }
  return std::nullopt;
}

std::vector<StandIn> find_stand_ins(const Mesh& mesh, std::span<const std::string> kept) {
  return Finder(mesh, kept).run();
}

std::vector<std::uint32_t> remove_parts(Mesh& mesh, std::span<const std::uint32_t> parts) {
  std::vector<std::uint8_t> goes(mesh.parts.size(), 0), used(mesh.positions.size(), 0),
      freed(mesh.positions.size(), 0);
  for (const std::uint32_t p : parts) goes[p] = 1;
  std::vector<std::uint32_t> kept;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const bool stays = goes[mesh.part_of[t]] == 0;
    for (const std::uint32_t v : mesh.triangles[t]) (stays ? used : freed)[v] = 1;
    if (stays) kept.push_back(t);
  }
  keep_rows(mesh.triangles, kept);
  keep_rows(mesh.normal_triangles, kept);
  keep_rows(mesh.texcoord_triangles, kept);
  keep_rows(mesh.part_of, kept);
  keep_rows(mesh.face_of, kept);
  std::vector<std::uint32_t> place(mesh.positions.size());
  std::uint32_t left = 0;
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    if (freed[v] && !used[v]) continue;
    mesh.positions[left] = mesh.positions[v];
    place[v] = left++;
  }
  mesh.positions.resize(left);
  for (Triangle& t : mesh.triangles) {
    for (std::uint32_t& v : t) v = place[v];
  }
  return kept;
}

}  // namespace copse
