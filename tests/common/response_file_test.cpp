#include "tools/common/response_file.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

namespace copse {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

class ResponseFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / (std::string("copse_response_") + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  std::string at(const std::string& name) const { return std::string("@") + (folder_ / name).string(); }

  fs::path folder_;
};

Words split(const std::string& text) {
  const auto words = split_arguments(text, "x");
  EXPECT_TRUE(words) << text;
  return words.value_or(Words{});
}

TEST(SplitArguments, SplitsAtAnyWhiteSpace) {
  EXPECT_EQ(split(" a\tb\n\n c\r\n"), (Words{"a", "b", "c"}));
  EXPECT_EQ(split(""), Words{});
}

TEST(SplitArguments, QuotesKeepWhiteSpaceAndMakeEmptyArguments) {
  EXPECT_EQ(split("'a b' \"c 'd\" '' e\"f g\"h"), (Words{"a b", "c 'd", "", "ef gh"}));
}

TEST(SplitArguments, ABackslashTakesTheNextCharacterAsItIs) {
  EXPECT_EQ(split(R"(a\ b \"c\" "d\"e" 'f\'g' \\ h\)"), (Words{"a b", "\"c\"", "d\"e", "f'g", "\\", "h\\"}));
}

TEST(SplitArguments, RefusesAQuoteThatIsNeverClosed) {
  const auto words = split_arguments("a 'b c", "x.rsp");
  ASSERT_FALSE(words);
  EXPECT_EQ(words.error().fault, Fault::usage);
  EXPECT_EQ(words.error().file, "x.rsp");
}

TEST_F(ResponseFile, PutsTheArgumentsInPlace) {
  file("inner", "three 'four five'");
  file("outer", std::string("two ") + at("inner") + " six");
  const auto expanded = expand_response_files({"one", at("outer"), "seven"});
  ASSERT_TRUE(expanded);
  EXPECT_EQ(expanded->arguments, (Words{"one", "two", "three", "four five", "six", "seven"}));
  EXPECT_EQ(expanded->files, (std::vector<fs::path>{folder_ / "outer", folder_ / "inner"}));
}

TEST_F(ResponseFile, LeavesWhatFollowsTwoDashesAndALoneAtSign) {
  const auto expanded = expand_response_files({"@", "--", "@nothing"});
  ASSERT_TRUE(expanded);
  EXPECT_EQ(expanded->arguments, (Words{"@", "--", "@nothing"}));
}

TEST_F(ResponseFile, MissingIsAnIoError) {
  const auto expanded = expand_response_files({at("none")});
  ASSERT_FALSE(expanded);
  EXPECT_EQ(expanded.error().fault, Fault::io);
}

TEST_F(ResponseFile, ThatNamesItselfIsRefused) {
  file("loop", at("loop"));
  const auto expanded = expand_response_files({at("loop")});
  ASSERT_FALSE(expanded);
  EXPECT_EQ(expanded.error().fault, Fault::usage);
}

TEST_F(ResponseFile, ThatMultipliesIsRefusedBeforeItFillsTheMemory) {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += at("bomb") + " ";
  file("bomb", text);
  const auto expanded = expand_response_files({at("bomb")});
  ASSERT_FALSE(expanded);
  EXPECT_EQ(expanded.error().fault, Fault::usage);
}

}  // namespace
}  // namespace copse
