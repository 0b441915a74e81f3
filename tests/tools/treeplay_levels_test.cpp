// treeplay with levels of detail, as a user calls it.
#include "lib/formats/import/image.h"
#include "lib/formats/material.h"
#include "tests/tools/little_obj.h"
#include "tests/tools/process.h"

#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace copse {
namespace {

class TreeplayLevels : public testing::Test {
 protected:
  void SetUp() override {
    write_text(folder_.path() / "oak.obj", little_tree_obj(8, 12, 60));
    ASSERT_EQ(run_process({"treeprep", folder_.file("oak.obj"), "-o", tree_, "-q"}).status, 0);
    ASSERT_EQ(bake({"--continuous"}).status, 0);
  }
  Outcome bake(std::vector<std::string> more) const {
    std::vector<std::string> command{"lodbake", tree_, "-o",       levels_, "--discrete", "0.5,0.2",
                                     "--near",  "20",  "--medium", "60",    "-q"};
    command.insert(command.end(), more.begin(), more.end());
    return run_process(command);
  }
  Outcome play(const std::string& what, std::vector<std::string> more) const {
    std::vector<std::string> command{"treeplay", what, "--samples", "4", "--size", "64x64"};
    command.insert(command.end(), more.begin(), more.end());
    return run_process(command);
  }
  Image flat(const std::string& what, std::vector<std::string> more) const {
    for (const char* o : {"--unlit", "--background", "black", "--no-ground", "--camera", "3,6,30,0,6,0"})
      more.emplace_back(o);
    more.insert(more.end(), {"--frames", folder_.file("flat.png")});
    const Outcome o = play(what, more);
    EXPECT_EQ(o.status, 0) << o.err;
    auto image = read_image(folder_.file("flat.png"));
    return image ? std::move(*image) : Image{};
  }
  // A column of the statistics, frame by frame.
  std::vector<std::string> column(std::vector<std::string> more, const std::string& name) const {
    more.insert(more.end(), {"--headless", "--stats", folder_.file("s.csv")});
    const Outcome o = play(levels_, more);
    EXPECT_EQ(o.status, 0) << o.err;
    std::istringstream text(read_text(folder_.file("s.csv")));
    std::vector<std::string> out;
    std::size_t wanted = k_none;
    for (std::string line; std::getline(text, line);) {
      std::istringstream cells(line);
      std::string cell;
      for (std::size_t i = 0; std::getline(cells, cell, ','); ++i) {
        if (i == wanted) out.push_back(cell);
        if (cell == name) wanted = i;
      }
    }
    return out;
  }

  TemporaryFolder folder_;
  std::string tree_ = folder_.file("oak.stree"), levels_ = folder_.file("oak.lod.stree");
};

int difference(const Image& a, const Image& b) {
  int sum = 0;
  for (std::size_t i = 0; i < a.rgba.size() && i < b.rgba.size(); ++i)
    sum += std::abs(int{a.rgba[i]} - int{b.rgba[i]}) > 2 ? 1 : 0;
  return sum;
}

TEST_F(TreeplayLevels, ALevelLooksLikeWhatTreedumpExportsOfIt) {
  const Image full = flat(tree_, {});
  EXPECT_EQ(difference(flat(levels_, {"--level", "0"}), full), 0);
  const std::string obj = folder_.file("level.obj");
  ASSERT_EQ(run_process({"treedump", levels_, "--export", obj, "--level", "2"}).status, 0);
  const Image level = flat(levels_, {"--level", "2"});
  EXPECT_EQ(difference(level, flat(obj, {})), 0);
  EXPECT_GT(difference(level, full), 0);
}

TEST_F(TreeplayLevels, AShareIsNeverExceededAndAnErrorIsKept) {
  const double full = std::stod(column({}, "triangles").at(0));
  EXPECT_LE(std::stod(column({"--ratio", "0.3"}, "triangles").at(0)), 0.3 * full);
  EXPECT_LE(std::stod(column({"--max-error", "0.1"}, "level_error").at(0)), 0.1);
  EXPECT_EQ(std::stod(column({"--max-error", "0"}, "triangles").at(0)), full);
}

// The borders are at 20 and 60 m, ten percent of hysteresis.
TEST_F(TreeplayLevels, ByDistanceTheyChangeAtTheirBordersWithHysteresis) {
  const std::string path = folder_.file("path.json");
  std::string keys;
  for (const auto& [time, z] :
       {std::pair{0, 5}, {1, 21}, {2, 40}, {3, 62}, {4, 80}, {5, 57}, {6, 19}, {7, 5}})
    keys +=
        fmt::format(R"({}{{"time":{},"eye":[0,6,{}],"target":[0,6,0]}})", keys.empty() ? "" : ",", time, z);
  write_text(path, fmt::format(R"({{"schema":"copse.path/1","keys":[{}]}})", keys));
  const auto levels = column({"--lod", "auto", "--path", path, "--count", "8"}, "level");
  EXPECT_EQ(levels, (std::vector<std::string>{"0", "0", "1", "1", "2", "2", "1", "0"}));
}

TEST_F(TreeplayLevels, InBetweenTheTrianglesFallWithEveryMetre) {
  const auto triangles = column(
      {"--lod", "spectrum", "--path", "linear", "--camera", "0,6,90,0,6,0", "--count", "6"}, "triangles");
  ASSERT_EQ(triangles.size(), 6u);
  for (std::size_t i = 1; i < 6; ++i) EXPECT_GE(std::stoi(triangles[i]), std::stoi(triangles[i - 1]));
  EXPECT_LT(std::stoi(triangles[0]), std::stoi(triangles[5]));
}

TEST_F(TreeplayLevels, BehindTheLastLevelComesTheImpostor) {
  ASSERT_EQ(bake({"--impostor", "64"}).status, 0);
  const Image full = flat(levels_, {}), pictures = flat(levels_, {"--level", "3"});
  int both = 0, either = 0;
  for (std::size_t p = 0; p < full.rgba.size() && p < pictures.rgba.size(); p += 4) {
    const bool a = full.rgba[p + 1] > 20, b = pictures.rgba[p + 1] > 20;
    both += a && b, either += a || b;
  }
  EXPECT_GT(both, 0.5 * either);
  EXPECT_EQ(column({"--level", "3"}, "triangles"), (std::vector<std::string>{"2"}));
  const auto levels =
      column({"--lod", "auto", "--path", "linear", "--camera", "0,6,600,0,6,0", "--count", "3"}, "level");
  EXPECT_EQ(levels.front(), "3");
  EXPECT_NE(levels.back(), "3");
}

TEST_F(TreeplayLevels, LinesAndPointsTakeOverFromTrianglesWithDistance) {
  const auto seen = [&](const char* camera, const char* what) {
    return std::stoi(column({"--lod", "lines-points", "--camera", camera}, what).at(0));
  };
  const char *near = "0,6,4,0,6,0", *far = "0,6,70,0,6,0";
  EXPECT_GT(seen(near, "triangles"), 4 * seen(far, "triangles"));
  EXPECT_EQ(seen(near, "points"), 0);
  EXPECT_GT(seen(far, "lines"), 0);
  EXPECT_GT(seen(far, "points"), 0);
  // What is drawn covers about what the triangles cover; points lie side by side where leaves overlap.
  const auto covered = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"--unlit", "--background", "black", "--no-ground", "--camera", "0,6,50,0,6,0",
                             "--frames", folder_.file("far.png")});
    EXPECT_EQ(play(tree_, more).status, 0);
    const auto image = read_image(folder_.file("far.png"));
    double sum = 0;
    for (std::size_t p = 0; image && p < image->rgba.size(); p += 4) sum += image->rgba[p];
    return sum;
  };
  const double triangles = covered({}), primitives = covered({"--lod", "lines-points"});
  EXPECT_GT(primitives, 0.5 * triangles);
  EXPECT_LT(primitives, 2 * triangles);
}

TEST_F(TreeplayLevels, FoliageIsDrawnInFullFromNearAndAsASubsetFromFar) {
  ASSERT_EQ(bake({"--foliage", "prune", "--cells", "4", "--views", "12", "--far", "200"}).status, 0);
  const auto seen = [&](const char* camera) {
    return std::stoi(column({"--lod", "foliage", "--camera", camera}, "triangles").at(0));
  };
  const int full = std::stoi(column({}, "triangles").at(0));
  EXPECT_EQ(seen("0,10,1.5,0,10,0"), full) << "from inside the crown";
  const int middle = seen("0,6,80,0,6,0"), far = seen("0,6,500,0,6,0");
  EXPECT_LT(middle, full);
  EXPECT_LT(far, middle);
  EXPECT_GT(far, full - 60) << "the trunk is drawn in full";
}

TEST_F(TreeplayLevels, WhatTheFileCannotDoIsSaidInOneLine) {
  const auto says = [&](const std::string& file, const std::vector<std::string>& more, int status,
                        const std::string& text) {
    std::vector<std::string> options = more;
    options.insert(options.end(), {"--headless", "-q"});
    const Outcome o = play(file, options);
    EXPECT_EQ(o.status, status) << o.err;
    EXPECT_EQ(line_count(o.err), 1u) << o.err;
    EXPECT_NE(o.err.find(text), std::string::npos) << o.err;
  };
  says(tree_, {"--level", "1"}, 1, "lodbake");
  says(folder_.file("oak.obj"), {"--lod", "auto"}, 1, "treeprep");
  says(levels_, {"--level", "7"}, 1, "numbered 7");
  says(levels_, {"--level", "1", "--ratio", "0.5"}, 2, "excludes");
  says(folder_.file("oak.obj"), {"--lod", "lines-points"}, 1, "treeprep");
  says(levels_, {"--lod", "foliage"}, 1, "--foliage prune");
  says(levels_, {"--lod", "magic"}, 2, "--lod");
  ASSERT_EQ(bake({}).status, 0);
  says(levels_, {"--lod", "spectrum"}, 1, "--continuous");
}

}  // namespace
}  // namespace copse
