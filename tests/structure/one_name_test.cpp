// One algorithm, one header, one .cpp, one test, one section, one name.
#include "tests/structure/repository.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(Structure, EveryAnalysisHeaderWithCodeHasATestAndASectionOfItsName) {
  std::size_t seen = 0;
  for (const auto& header : files_below("lib/analysis", {".h"})) {
    const std::string name = header.stem().string(), room = header.parent_path().filename().string();
    const auto source = k_root / header.parent_path() / (name + ".cpp");
    if (!std::filesystem::exists(source)) continue;  // a header of types alone
    ++seen;
    EXPECT_TRUE(std::filesystem::exists(k_root / "tests" / room / (name + "_test.cpp")))
        << header << " needs tests/" << room << "/" << name << "_test.cpp";
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
