// treeplay on ecosystems.
#include "lib/formats/import/image.h"
#include "tests/tools/process.h"
#include "tests/tools/rich_tree.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

using Strings = std::vector<std::string>;

// Nine trees on a square of 40 m, looked at from the south.
class TreeplayForest : public testing::Test {
 protected:
  void SetUp() override {
    write_rich_tree(folder_);
    write_text(file("page.json"), R"({"terrain": {"size": [40, 40]},
      "types": [{"name": "rich", "tree": "rich.stree", "count": 9, "scale": 0.5}]})");
    const Outcome o = run_process({"ecogen", file("page.json"), "-o", file("f.eco")});
    ASSERT_EQ(o.status, 0) << o.err;
  }
  std::string file(const std::string& name) const { return folder_.file(name); }
  Outcome play(Strings more) const {
    Strings command{"treeplay", file("f.eco"), "--size",      "48x32",   "--samples",
                    "1",        "--frames",    file("f.png"), "--stats", file("f.csv")};
    command.insert(command.end(), more.begin(), more.end());
    return run_process(command);
  }
  // Column `column` of the only frame.
  double stat(std::size_t column) const {
    std::string row = read_text(file("f.csv"));
    row = row.substr(row.find('\n') + 1);
    for (; column > 0; --column) row = row.substr(row.find(',') + 1);
    return std::stod(row);
  }
  double triangles(const Strings& more) const {
    const Outcome o = play(more);
    EXPECT_EQ(o.status, 0) << o.err;
    EXPECT_EQ(stat(10), 9) << "instances drawn";
    return stat(6);
  }

  TemporaryFolder folder_;
};

TEST_F(TreeplayForest, TreesTakeTheLevelOfTheirDistance) {
  const Strings far{"--camera", "20,10,90,20,2,20,40"}, afar{"--camera", "20,60,300,20,2,20,20"};
  Strings full = far;
  full.insert(full.end(), {"--level", "0"});
  const double all = triangles(full), some = triangles(far), few = triangles(afar);
  EXPECT_LT(some, 0.8 * all);
  EXPECT_LE(few, some);
  EXPECT_GT(few, 0.1 * all);  // two levels, no nothing
}

TEST_F(TreeplayForest, TheGroundGoesOnWhereTheTerrainEnds) {
  // Away from the terrain, down and up.
  for (const bool down : {true, false}) {
    ASSERT_EQ(play({"--camera", down ? "20,6,60,20,0,80,30" : "20,6,60,20,40,80,30"}).status, 0);
    const auto image = read_image(file("f.png"));
    ASSERT_TRUE(image);
    const std::uint8_t* middle = image->rgba.data() + 4 * (16 * 48 + 24);
    EXPECT_EQ(middle[1] > middle[2], down);  // grass is green, the sky is blue
  }
}

TEST_F(TreeplayForest, WhatItCannotShowItSays) {
  for (const Strings& wish : {Strings{"--show", "skeleton"}, {"--level", "2"}, {"--ratio", "0.5"}}) {
    const Outcome o = play(wish);
    EXPECT_EQ(o.status, 2);
    EXPECT_NE(o.err.find("is an ecosystem"), std::string::npos) << o.err;
    EXPECT_EQ(line_count(o.err), 1u);
  }
}

}  // namespace
}  // namespace copse
