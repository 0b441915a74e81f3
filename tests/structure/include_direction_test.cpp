// Includes point one way: tools -> analysis, runtime -> formats; analysis and runtime never see each other.
// The folders of formats are ordered, too.
#include "tests/structure/repository.h"

#include <map>

#include <gtest/gtest.h>

namespace copse {
namespace {

// Every room, and the rooms that it may include besides itself.
const std::map<std::string, std::vector<std::string>>& allowed() {
  static const std::string f = "lib/formats";
  static const std::vector<std::string> k_formats{f,
                                                  f + "/container",
                                                  f + "/volumes",
                                                  f + "/tree",
                                                  f + "/packing",
                                                  f + "/tree_file",
                                                  f + "/levels",
                                                  f + "/ecosystem"};
  static const auto with = [](std::vector<std::string> rooms, std::initializer_list<std::string> more) {
    rooms.insert(rooms.end(), more);
    return rooms;
  };
  static const std::map<std::string, std::vector<std::string>> k_allowed{
      {f, {}},
      {f + "/container", {f}},
      {f + "/volumes", {f}},
      {f + "/tree", {f, f + "/volumes"}},
      {f + "/packing", {f, f + "/container", f + "/tree"}},
      {f + "/tree_file", {f, f + "/container", f + "/volumes", f + "/tree", f + "/packing"}},
      {f + "/levels", {f, f + "/container", f + "/volumes", f + "/tree", f + "/packing", f + "/tree_file"}},
      {f + "/ecosystem", {f, f + "/container", f + "/volumes", f + "/tree", f + "/tree_file"}},
      {f + "/import", k_formats},
      {f + "/export", k_formats},
      {"lib/analysis", k_formats},
      {"lib/runtime", k_formats},
      {"tools", with(k_formats, {f + "/import", f + "/export", "lib/analysis", "lib/runtime"})},
  };
  return k_allowed;
}

// The room of a path: the longest that is known.
std::string room_of(const std::string& path) {
  std::string best;
  for (const auto& [room, _] : allowed()) {
    if (path.starts_with(room + "/") && room.size() > best.size()) best = room;
  }
  return best;
}

std::vector<std::string> breaches(const std::filesystem::path& file,
                                  const std::vector<std::string>& includes) {
  std::vector<std::string> out;
  const std::string own = room_of(file.string());
  const std::vector<std::string>& rooms = allowed().at(own);
  for (const std::string& include : includes) {
    if (include.front() != '"') continue;
    const std::string target = include.substr(1, include.size() - 2);
    const std::string room = room_of(target);
    if (room != own && std::find(rooms.begin(), rooms.end(), room) == rooms.end()) {
      out.push_back(file.string() + " includes " + include);
    }
  }
  return out;
}

TEST(Structure, IncludesPointOneWay) {
  std::size_t seen = 0;
  for (const char* folder : {"lib", "tools"}) {
    for (const auto& file : files_below(folder, {".h", ".cpp"})) {
      ++seen;
      for (const std::string& breach : breaches(file, includes_of(file))) ADD_FAILURE() << breach;
    }
  }
  EXPECT_GT(seen, 20u);
}

TEST(Structure, ABreachOfTheIncludeDirectionIsFound) {
  EXPECT_EQ(breaches("lib/runtime/x.cpp", {"\"lib/analysis/surface/weld.h\""}).size(), 1u);
  EXPECT_EQ(breaches("lib/formats/x.cpp", {"\"lib/formats/import/import.h\""}).size(), 1u);
  EXPECT_EQ(breaches("lib/formats/tree/x.cpp", {"\"lib/formats/tree_file/tree_file.h\""}).size(), 1u);
  EXPECT_EQ(breaches("lib/formats/x.cpp", {"\"lib/formats/tree/tree.h\""}).size(), 1u);
  EXPECT_EQ(breaches("lib/analysis/x.cpp", {"\"tests/x.h\""}).size(), 1u);
  EXPECT_EQ(breaches("lib/analysis/x.cpp", {"\"lib/formats/mesh.h\"", "<vector>"}).size(), 0u);
}

TEST(Structure, PublicHeadersOfLibShowNoThirdPartyType) {
  for (const auto& file : files_below("lib", {".h"})) {
    for (const std::string& include : includes_of(file)) {
      const bool standard = include.front() == '<' && include.find_first_of("./") == std::string::npos;
      EXPECT_TRUE(include.front() == '"' || standard) << file << " includes " << include;
    }
  }
}

}  // namespace
}  // namespace copse
