#include "lib/analysis/leaves/glob.h"

#include <string>

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(Glob, MatchesTheWholeNameInEitherCase) {
  EXPECT_TRUE(glob_match("bark", "Bark"));
  EXPECT_FALSE(glob_match("bark", "Bark2"));
  EXPECT_FALSE(glob_match("bark", "bar"));
  EXPECT_TRUE(glob_match("", ""));
  EXPECT_FALSE(glob_match("", "a"));
}

TEST(Glob, AStarStandsForAnyCharactersAndForNone) {
  EXPECT_TRUE(glob_match("*leaf*", "oak_Leaf.001"));
  EXPECT_TRUE(glob_match("leaf*", "leaf"));
  EXPECT_TRUE(glob_match("*", ""));
  EXPECT_TRUE(glob_match("a*b*c", "a-b-b-c"));
  EXPECT_FALSE(glob_match("a*b*c", "a-c-b"));
  EXPECT_TRUE(glob_match("**", "x"));
}

TEST(Glob, AQuestionMarkStandsForOneCharacterWhateverItsBytes) {
  EXPECT_TRUE(glob_match("l?af", "leaf"));
  EXPECT_TRUE(glob_match("?corce",
                         "\xc3\xa9"
                         "corce"));
  EXPECT_TRUE(glob_match("*?corce",
                         "x\xc3\xa9"
                         "corce"));
  EXPECT_FALSE(glob_match("?", ""));
  EXPECT_TRUE(glob_match("?", "\xff"));  // not UTF-8: bytes are characters
}

TEST(Glob, SetsHoldCharactersRangesAndTheirNegation) {
  EXPECT_TRUE(glob_match("branch-0[1-3]", "branch-02"));
  EXPECT_FALSE(glob_match("branch-0[1-3]", "branch-04"));
  EXPECT_TRUE(glob_match("[!b]ark", "dark"));
  EXPECT_FALSE(glob_match("[!b]ark", "Bark"));
  EXPECT_TRUE(glob_match("[]x]", "]"));
  EXPECT_TRUE(glob_match("[A-C]", "b"));
  EXPECT_TRUE(glob_match("[ab", "[ab"));
}

TEST(Glob, ABackslashTakesTheNextCharacterAsItIs) {
  EXPECT_TRUE(glob_match("a\\*", "a*"));
  EXPECT_FALSE(glob_match("a\\*", "ab"));
  EXPECT_TRUE(glob_match("a\\", "a\\"));
}

TEST(Glob, ManyStarsAreNoTrap) {
  std::string pattern;
  for (int i = 0; i < 200; ++i) pattern += "*a";
  EXPECT_FALSE(glob_match(pattern + "b", std::string(20000, 'a')));
}

}  // namespace
}  // namespace copse
