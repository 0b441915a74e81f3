#include "lib/analysis/leaves/name_words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace copse {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

bool says(NameClass kind, bool strong, std::string_view name) {
  const NameHint hint = name_hint(name);
  return hint.kind == kind && (kind == NameClass::none || hint.strong == strong);
}
bool trunk(std::string_view name) {
  return says(NameClass::trunk, true, name);
}
bool weak_trunk(std::string_view name) {
  return says(NameClass::trunk, false, name);
}
bool leaf(std::string_view name) {
  return says(NameClass::leaf, true, name);
}
bool weak_leaf(std::string_view name) {
  return says(NameClass::leaf, false, name);
}
bool nothing(std::string_view name) {
  return says(NameClass::none, false, name);
}

TEST(NameWords, SplitsWhereAPersonWould) {
  EXPECT_THAT(words_of("Bark_NormalTree.001"), ElementsAre("bark", "normal", "tree"));
  EXPECT_THAT(words_of("leafsFall"), ElementsAre("leafs", "fall"));
  EXPECT_THAT(words_of("MATBark"), ElementsAre("mat", "bark"));
  EXPECT_THAT(words_of("branch-01-1"), ElementsAre("branch"));
  EXPECT_THAT(words_of("_defaultMat"), ElementsAre("default", "mat"));
  EXPECT_THAT(words_of("BARK"), ElementsAre("bark"));
  EXPECT_THAT(words_of("12.3"), IsEmpty());
  EXPECT_THAT(words_of(""), IsEmpty());
}

TEST(NameWords, DropsAccentsAndSurvivesWhatIsNotText) {
  EXPECT_THAT(words_of("\u00c9corce"), ElementsAre("ecorce"));
  EXPECT_THAT(words_of("Bl\u00e4tter"), ElementsAre("blatter"));
  EXPECT_THAT(words_of("Ga\u0142\u0105\u017a"), ElementsAre("galaz"));
  EXPECT_THAT(words_of("Stra\u00dfe"), ElementsAre("strasse"));
  EXPECT_THAT(words_of("\xff\xfe"
                       "bark\xc3"),
              ElementsAre("bark"));
}

TEST(NameWords, KnowsTheNamesOfRealFiles) {
  for (const char* name :
       {"Bark_NormalTree", "bark", "trunk-01-1", "woodBirch", "wood", "Bark_DeadTree", "trunk"})
    EXPECT_TRUE(trunk(name)) << name;
  for (const char* name : {"branches", "stems_1", "stem", "twigs", "branch-01-1"})
    EXPECT_TRUE(weak_trunk(name)) << name;
  for (const char* name : {"Leaves_NormalTree", "Leaves_Pine", "leaf", "leaves.001", "leafsFall", "Leaves"})
    EXPECT_TRUE(leaf(name)) << name;
  for (const char* name : {"HalloweenBits", "colormap", "_defaultMat", "tree.001", "Object_7", "Fern_1",
                           "CommonTree_1", "Material.001", ""})
    EXPECT_TRUE(nothing(name)) << name;
  EXPECT_TRUE(weak_leaf("grass-trees-tall"));
}

TEST(NameWords, ReadsManyLanguages) {
  for (const char* name : {"Baumrinde", "Eichenstamm", "\u00c9corce", "tronco_01", "Corteccia", "schors",
                           "\u043a\u043e\u0440\u0430", "\u6811\u5e72_mat", "Holz"})
    EXPECT_TRUE(trunk(name)) << name;
  for (const char* name : {"Bl\u00e4tter", "Laub", "feuillage", "hojas", "Folhas", "foglie", "naalden",
                           "\u041b\u0438\u0441\u0442\u044c\u044f", "\u6811\u53f6", "\u8449", "Li\u015bcie"})
    EXPECT_TRUE(leaf(name)) << name;
  for (const char* name : {"\u00c4ste", "ramas", "Branche", "\u679d"}) EXPECT_TRUE(weak_trunk(name)) << name;
}

TEST(NameWords, MatchesWholeWordsAndKnownCompoundsOnly) {
  EXPECT_TRUE(trunk("treebark"));
  EXPECT_TRUE(leaf("mapleleaves"));
  EXPECT_TRUE(leaf("leaftexture"));
  EXPECT_TRUE(trunk("oakbarktex"));
  for (const char* name :
       {"embark", "login", "catalog", "barkeeper", "cleaver", "sleaves", "castle", "woods"})
    EXPECT_TRUE(nothing(name)) << name;
}

TEST(NameWords, ALeafWordBeatsAWeakTrunkWordAndEqualsCancel) {
  EXPECT_TRUE(leaf("leaf_branch"));
  EXPECT_TRUE(leaf("twig_leaves"));
  EXPECT_TRUE(nothing("bark_and_leaves"));
  EXPECT_TRUE(trunk("bush_bark"));
}

TEST(NameWords, GrassIsAWeakLeafWordOfItsOwn) {
  for (const char* name : {"grass_01", "Gras", "\u0442\u0440\u0430\u0432\u0430", "\u8349"}) {
    EXPECT_TRUE(weak_leaf(name)) << name;
    EXPECT_TRUE(name_hint(name).grass) << name;
  }
  EXPECT_FALSE(name_hint("crown").grass);
  EXPECT_FALSE(name_hint("grass_leaf").grass);
}

TEST(NameWords, NamesTheWordThatItFound) {
  EXPECT_EQ(name_hint("Bark_NormalTree").word, "bark");
  EXPECT_EQ(name_hint("oakleaves").word, "leaves");
}

}  // namespace
}  // namespace copse
