#include "tools/treegrow/breaks.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

#include <gtest/gtest.h>

namespace copse::grow {
namespace {

TEST(Breaks, TheTableNamesEachOnceInTheOrderOfTheEnum) {
  const auto& table = break_table();
  ASSERT_EQ(table.size(), k_break_count);
  std::set<std::string> names;
  for (std::size_t i = 0; i < table.size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(table[i].id), i) << table[i].name;
    EXPECT_TRUE(names.insert(table[i].name).second) << table[i].name;
  }
}

TEST(Breaks, TheDocsHaveARowForEach) {
  std::ifstream in(COPSE_SOURCE_DIR "/docs/treegrow.md");
  const std::string docs{std::istreambuf_iterator<char>(in), {}};
  static const char* const k_groups[] = {"", "join", "ends", "turned", "leaf", "names", "root"};
  for (const BreakInfo& info : break_table()) {
    const std::string row = std::string("| `") + info.name + "` | " + k_groups[static_cast<int>(info.group)] +
                            " | " + info.what + " | " + info.truth + " |\n";
    EXPECT_NE(docs.find(row), std::string::npos) << row;
  }
}

TEST(Breaks, EveryNameIsUnderstood) {
  for (const BreakInfo& info : break_table()) {
    const auto breaks = parse_breaks(info.name);
    ASSERT_TRUE(breaks) << info.name;
    EXPECT_EQ(breaks->names(), std::vector<std::string>{info.name});
  }
}

TEST(Breaks, NoneIsTheStrictModelAndArtistCanBeChanged) {
  EXPECT_TRUE(parse_breaks("none")->none());
  EXPECT_EQ(*parse_breaks("artist"), artist_breaks());
  const auto changed = parse_breaks("open-ends,artist,shuffled");
  ASSERT_TRUE(changed);
  EXPECT_TRUE(changed->has(Break::open_ends));
  EXPECT_FALSE(changed->has(Break::pointed)) << "the artist's end gives way to the one that is named";
  EXPECT_TRUE(changed->has(Break::shuffled));
  EXPECT_TRUE(changed->has(Break::free_tubes));
}

TEST(Breaks, WhatExcludesAnotherIsAUsageErrorThatNamesBoth) {
  const auto error = parse_breaks("free-tubes,seams,extruded").error();
  EXPECT_EQ(error.fault, Fault::usage);
  EXPECT_NE(error.what.find("free-tubes"), std::string::npos);
  EXPECT_NE(error.what.find("extruded"), std::string::npos);
  EXPECT_TRUE(parse_breaks("seams,seams"));
}

TEST(Breaks, UnknownNamesAreUsageErrors) {
  for (const char* list : {"cracks", "", "seams,", "Seams", "free_tubes"}) {
    const auto breaks = parse_breaks(list);
    ASSERT_FALSE(breaks) << list;
    EXPECT_EQ(breaks.error().fault, Fault::usage);
  }
}

}  // namespace
}  // namespace copse::grow
