// One algorithm, one header, one .cpp, one test, one section, one name.
#include "tests/structure/repository.h"

#include <set>

#include <gtest/gtest.h>

namespace copse {
namespace {

// Parts of the trunk analysis that are tested through the whole (bench/hierarchy.py, tests/tools) and still
// owe a test of their own. The list may only get shorter: a part that has its test must come off it.
const std::set<std::string> k_owed{"trunk/recover", "trunk/welded"};

TEST(Structure, EveryAnalysisHeaderWithCodeHasATestAndASectionOfItsName) {
  std::size_t seen = 0;
  for (const auto& header : files_below("lib/analysis", {".h"})) {
    const std::string name = header.stem().string(), room = header.parent_path().filename().string();
    const auto source = k_root / header.parent_path() / (name + ".cpp");
    if (!std::filesystem::exists(source)) continue;  // a header of types alone
    ++seen;
    const bool tested = std::filesystem::exists(k_root / "tests" / room / (name + "_test.cpp"));
    EXPECT_NE(tested, k_owed.contains(room + "/" + name)) << header << " needs tests/" << room << "/" << name
                                                          << "_test.cpp, or has it and is listed as owing it";
    EXPECT_NE(text_of(k_root / "docs" / (room + ".md")).find("\n## " + name + "\n"), std::string::npos)
        << header << " has no section '## " << name << "' in docs/" << room << ".md";
  }
  EXPECT_GT(seen, 3u);
}

TEST(Structure, NoFileIsTooLongToBeOneRoom) {
  for (const char* folder : {"lib", "tools", "tests", "bench", "fuzz"}) {
    for (const auto& file : files_below(folder, {".h", ".cpp"})) {
      const std::string text = text_of(k_root / file);
      EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 700) << file;
    }
  }
}

TEST(Structure, EveryHeaderIsIncludedOnce) {
  for (const char* folder : {"lib", "tools", "tests", "bench", "fuzz"}) {
    for (const auto& file : files_below(folder, {".h"})) {
      EXPECT_NE(text_of(k_root / file).find("#pragma once"), std::string::npos) << file;
    }
  }
}

}  // namespace
}  // namespace copse
