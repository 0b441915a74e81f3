#include "tools/treegrow/species_toml.h"

#include <gtest/gtest.h>

namespace copse::grow {
namespace {

TEST(SpeciesToml, EveryBuiltInSpeciesIsSoundAndNamedAsItsFile) {
  EXPECT_GE(species_names().size(), 8u);
  for (const std::string& name : species_names()) {
    const auto species = find_species(name);
    ASSERT_TRUE(species) << name;
    EXPECT_EQ(species->name, name);
    EXPECT_FALSE(species->summary.empty());
    EXPECT_GE(species->levels.size(), 1u);
  }
  EXPECT_FALSE(find_species("triffid"));
}

TEST(SpeciesToml, WhatIsPrintedReadsBackTheSame) {
  for (const std::string& name : species_names()) {
    const std::string text = to_toml(*find_species(name));
    const auto again = species_from_toml(text, "x.toml");
    ASSERT_TRUE(again) << again.error().what;
    EXPECT_EQ(to_toml(*again), text);
  }
}

TEST(SpeciesToml, EveryParameterIsReadAndNotJustTheFirst) {
  // Each line changed by itself changes what is printed.
  const std::string text = to_toml(*find_species("oak"));
  std::size_t at = 0, numbers = 0;
  while ((at = text.find(" = ", at)) != std::string::npos) {
    at += 3;
    if (text[at] < '0' || text[at] > '9') continue;
    std::string changed = text;
    changed.replace(at, text.find_first_of(" \n", at) - at, text[at] == '1' ? "0.5" : "1");
    const auto species = species_from_toml(changed, "x.toml");
    if (!species) continue;  // out of that parameter's range
    ++numbers;
    EXPECT_NE(to_toml(*species), text) << text.substr(at - 30, 60);
  }
  EXPECT_GT(numbers, 80u);
}

TEST(SpeciesToml, ABaseGivesWhatIsNotNamed) {
  const auto species = species_from_toml(
      "base = \"birch\"  # begin with it\nname = \"mine\"\n[level1]\ncurve = -7\n", "x.toml");
  ASSERT_TRUE(species) << species.error().what;
  EXPECT_EQ(species->name, "mine");
  EXPECT_EQ(species->levels[1].curve, -7);
  EXPECT_EQ(species->levels.size(), find_species("birch")->levels.size());
  EXPECT_EQ(species->levels[1].branches, find_species("birch")->levels[1].branches);
}

struct Wrong {
  const char* text;
  const char* line;
  const char* what;
};

TEST(SpeciesToml, MistakesAreNamedWithTheirLine) {
  const Wrong wrongs[] = {
      {"heigth = 3", "line 1", "there is no parameter 'heigth'"},
      {"\n\nheight = tall", "line 3", "is not a number"},
      {"height = -1", "line 1", "is not a number from"},
      {"height = nan", "line 1", "is not a number"},
      {"height = 1e999", "line 1", "is not a number"},
      {"height", "line 1", "is not KEY = VALUE"},
      {"[level9]", "line 1", "there is no table"},
      {"[level0", "line 1", "there is no table"},
      {"name = oak", "line 1", "is not a \"string\""},
      {"envelope = \"cubic\"", "line 1", "is none of"},
      {"bark_colour = [1, 2]", "line 1", "is not"},
      {"bark_colour = [0.1, 0.2, 7]", "line 1", "from 0 to 1"},
      {"base = \"triffid\"", "line 1", "no built-in species"},
      {"[level0]\nbranches = 4", "line 2", "there is no parameter 'branches' in [level0]"},
  };
  for (const Wrong& wrong : wrongs) {
    const auto species = species_from_toml(wrong.text, "mine.toml");
    ASSERT_FALSE(species) << wrong.text;
    EXPECT_EQ(species.error().fault, Fault::refused);
    EXPECT_EQ(species.error().file, "mine.toml");
    EXPECT_EQ(species.error().what.rfind(wrong.line, 0), 0u) << species.error().what;
    EXPECT_NE(species.error().what.find(wrong.what), std::string::npos) << species.error().what;
  }
}

TEST(SpeciesToml, LevelsHaveNoGaps) {
  EXPECT_FALSE(species_from_toml("name = \"x\"\n", "x"));
  EXPECT_FALSE(species_from_toml("[level0]\n[level2]\n", "x"));
  EXPECT_FALSE(species_from_toml("[level1]\n", "x"));
  EXPECT_TRUE(species_from_toml("[level0]\n[level1]\n", "x"));
}

TEST(SpeciesToml, AHashInsideAStringIsNoComment) {
  const auto species = species_from_toml("name = \"tree #5\" # the fifth\n[level0]\n", "x");
  ASSERT_TRUE(species);
  EXPECT_EQ(species->name, "tree #5");
}

}  // namespace
}  // namespace copse::grow
