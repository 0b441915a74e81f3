#include "tools/common/console.h"

#include "tools/common/command_line.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(BarLine, ShowsShareAndTime) {
  EXPECT_EQ(bar_line("treeprep", "rings", 0.5, 3, 60),
            "treeprep: rings [##############              ]  50 %    3 s");
}

TEST(BarLine, NeverFillsTheLastColumn) {
  for (int width = 1; width < 120; ++width) {
    EXPECT_LT(bar_line("treeprep", "a long name of a stage", 0.4, 1234, width).size(),
              static_cast<std::size_t>(std::max(width, 2)));
  }
}

TEST(BarLine, WithoutAShareShowsTimeAlone) {
  EXPECT_EQ(bar_line("treeprep", "read", -1, 12.2, 80), "treeprep: read 12 s");
}

TEST(BarLine, IsFullOnlyAtTheEnd) {
  EXPECT_NE(bar_line("t", "s", 0.9999, 1, 80).find(" 99 %"), std::string::npos);
  EXPECT_NE(bar_line("t", "s", 7, 1, 80).find("100 %"), std::string::npos);
}

TEST(NearestName, FindsSlipsAndBeginnings) {
  const std::vector<std::string> names{"--report", "--html", "--seed", "--skeleton", "-o"};
  EXPECT_EQ(nearest_name("--reprot", names), "--report");
  EXPECT_EQ(nearest_name("--htm", names), "--html");
  EXPECT_EQ(nearest_name("--skel", names), "--skeleton");
  EXPECT_EQ(nearest_name("--sed", names), "--seed");
}

TEST(NearestName, DoesNotGuessWildly) {
  const std::vector<std::string> names{"--report", "--html", "-o"};
  EXPECT_EQ(nearest_name("--quality", names), "");
  EXPECT_EQ(nearest_name("-x", names), "");
  EXPECT_EQ(nearest_name(std::string(1000000, 'x'), names), "");
}

}  // namespace
}  // namespace copse
