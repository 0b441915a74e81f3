// Includes point one way: tools -> analysis, runtime -> formats; analysis and runtime never see each other.
#include "tests/structure/repository.h"

#include <map>

#include <gtest/gtest.h>

namespace copse {
namespace {

// The room of a path: the longest known prefix.
std::string room_of(const std::string& path) {
  static const std::vector<std::string> k_rooms{"lib/formats/import", "lib/formats/export", "lib/formats",
                                                "lib/analysis",       "lib/runtime",        "tools"};
  for (const std::string& room : k_rooms) {
    if (path.starts_with(room + "/")) return room;
  }
  return "";
}

const std::map<std::string, std::vector<std::string>>& allowed() {
  static const std::map<std::string, std::vector<std::string>> k_allowed{
      {"lib/formats", {"lib/formats"}},
      {"lib/formats/import", {"lib/formats", "lib/formats/import"}},
      {"lib/formats/export", {"lib/formats", "lib/formats/export"}},
      {"lib/analysis", {"lib/formats", "lib/analysis"}},
      {"lib/runtime", {"lib/formats", "lib/runtime"}},
      {"tools",
       {"lib/formats", "lib/formats/import", "lib/formats/export", "lib/analysis", "lib/runtime", "tools"}},
  };
  return k_allowed;
}

std::vector<std::string> breaches(const std::filesystem::path& file,
                                  const std::vector<std::string>& includes) {
  std::vector<std::string> out;
  const std::vector<std::string>& rooms = allowed().at(room_of(file.string()));
  for (const std::string& include : includes) {
    if (include.front() != '"') continue;
    const std::string target = include.substr(1, include.size() - 2);
    const std::string room = room_of(target);
    if (room.empty() || std::find(rooms.begin(), rooms.end(), room) == rooms.end()) {
      out.push_back(file.string() + " includes " + include);
    }
  }
  return out;
}

TEST(Structure, IncludesPointFromToolsToAnalysisAndRuntimeToFormats) {
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
