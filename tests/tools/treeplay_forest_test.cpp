// treeplay on ecosystems.
#include "lib/formats/ecosystem/ecosystem_file.h"
#include "lib/formats/import/image.h"
#include "tests/tools/process.h"
#include "tests/tools/rich_tree.h"

#include <filesystem>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

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

// One tree of 136 triangles, of about half from 10 m on and of a fifth from 40 m on.
class TreeplayOneTree : public TreeplayForest {
 protected:
  void SetUp() override {
    TreeplayForest::SetUp();
    write_text(file("page.json"), R"({"terrain": {"size": [40, 40]},
      "types": [{"name": "rich", "tree": "rich.stree", "instances": [{"x": 20, "z": 20}]}]})");
    ASSERT_EQ(run_process({"ecogen", file("page.json"), "-o", file("f.eco")}).status, 0);
    const auto levels = nlohmann::json::parse(
        run_process({"treedump", file("rich.stree"), "--json"}).out)["levels"]["discrete"];
    half_ = levels[0]["triangles"], fifth_ = levels[1]["triangles"];
    ASSERT_LE(half_, 68);
    ASSERT_LE(fifth_, 27);
  }
  // Triangles of a picture from so many metres away; seen_: how much light comes from the tree, which stands
  // in front of a black sky.
  double triangles(int away, const char* fade, const char* samples = "1") {
    const Outcome o = play({"--camera", "20,4," + std::to_string(20 + away) + ",20,4.1,20,40", "--fade", fade,
                            "--unlit", "--background", "black", "--samples", samples});
    EXPECT_EQ(o.status, 0) << o.err;
    const auto image = read_image(file("f.png"));
    EXPECT_TRUE(image);
    seen_ = 0;
    for (std::size_t i = 0; i < std::size_t{4} * 48 * 12; i += 4)  // above the horizon
      seen_ += image->rgba[i] + image->rgba[i + 1] + image->rgba[i + 2];
    return stat(6);
  }
  double seen_ = 0, half_ = 0, fifth_ = 0;
};

TEST_F(TreeplayOneTree, BetweenTwoLevelsBothAreDrawnEachInItsShareOfThePixels) {
  const double ground = triangles(8, "0", "4") - 136, fine = seen_;
  EXPECT_EQ(triangles(11, "0", "4"), ground + half_);
  const double coarse = seen_;
  // Together they cover what a tree covers: no sample is drawn by both, or by none.
  for (const char* samples : {"1", "4"}) {
    EXPECT_EQ(triangles(10, "0.3", samples), ground + 136 + half_);
    EXPECT_GT(seen_, 0.8 * std::min(fine, coarse)) << samples;
    EXPECT_LT(seen_, 1.2 * std::max(fine, coarse)) << samples;
  }
  EXPECT_EQ(triangles(5, "0.3"), ground + 136);
  EXPECT_EQ(play({"--fade", "0.6"}).status, 2);
}

TEST_F(TreeplayOneTree, WhatIsAFewPixelsHighCostsAHandfulOfTriangles) {
  const double ground = triangles(9, "0") - 136;
  EXPECT_EQ(triangles(60, "0"), ground + fifth_);
  const double few = triangles(400, "0") - ground;
  EXPECT_LE(few,
            std::min(16 / 0.75, fifth_));  // a level takes another's place if it has three quarters of it
  EXPECT_GT(few, 0);
  // A tree without any levels as well.
  ASSERT_EQ(run_process({"treeprep", file("rich.obj"), "-o", file("rich.stree")}).status, 0);
  ASSERT_EQ(run_process({"ecogen", file("page.json"), "-o", file("f.eco")}).status, 0);
  EXPECT_EQ(triangles(20, "0"), ground + 136);
  EXPECT_LE(triangles(100, "0"), ground + 64);
  EXPECT_LE(triangles(400, "0"), ground + 16);
}

// A plane of free points, y = x / 2.
TEST_F(TreeplayForest, HeightsCountFromAFreeSurfaceAsWell) {
  write_text(file("page.json"), R"({"terrain": {"samples": [5, 6], "nurbs": {"degree": [1, 1],
      "points": [[[0, 0, 0], [40, 20, 0]], [[8, 4, 40], [40, 20, 40]]]}},
      "types": [{"name": "rich", "tree": "rich.stree", "count": 4, "scale": 0.5}]})");
  ASSERT_EQ(run_process({"ecogen", file("page.json"), "-o", file("f.eco")}).status, 0);
  ASSERT_EQ(play({"--unlit", "--camera", "20,12,36,30,17,10"}).status, 0);
  const std::string picture = read_text(file("f.png"));
  ASSERT_EQ(play({"--unlit", "--camera", "20,2,36,30,2,10", "--above-ground"}).status, 0);
  EXPECT_EQ(read_text(file("f.png")), picture);
  const Outcome o = play({"--unlit", "--camera", "1,2,39,30,2,10", "--above-ground"});
  EXPECT_EQ(o.status, 2);
  EXPECT_NE(o.err.find("has no terrain at (1, 39)"), std::string::npos) << o.err;
}

// A cell of a table of the report, in the row that begins with `row`.
double reported(const std::string& report, const std::string& table, const std::string& row,
                std::size_t cell) {
  const auto json = nlohmann::json::parse(report);
  for (const auto& t : json["tables"])
    if (t["name"] == table)
      for (const auto& r : t["rows"])
        if (row.empty() || r[0] == row) return std::stod(r[cell].get<std::string>());
  ADD_FAILURE() << table << " has no " << row;
  return 0;
}

// Four thousand trees on a square of 400 m, their far level a picture.
class TreeplayLargeForest : public TreeplayForest {
 protected:
  void SetUp() override {
    TreeplayForest::SetUp();
    const Outcome baked =
        run_process({"lodbake", file("rich.stree"), "-o", file("far.stree"), "--discrete", "0.5,0.2",
                     "--near", "10", "--far", "40", "--impostor", "128", "--impostor-views", "4"});
    ASSERT_EQ(baked.status, 0) << baked.err;
    make("far.stree", {});
  }
  void make(const std::string& tree, const Strings& more) {
    write_text(
        file("page.json"),
        R"({"terrain": {"size": [400, 400], "samples": [129, 129], "faults": {"count": 40, "first": 4}},
      "block_trees": ["kd", "r"], "types": [{"name": "rich", "tree": ")" +
            tree + R"(", "count": 4000}]})");
    Strings command{"ecogen", file("page.json"), "-o", file("f.eco")};
    command.insert(command.end(), more.begin(), more.end());
    const Outcome o = run_process(command);
    ASSERT_EQ(o.status, 0) << o.err;
  }
  const Strings eye_{"--camera", "200,2,390,200,4,200,40", "--above-ground"};
  Strings with(Strings more) const {
    more.insert(more.end(), eye_.begin(), eye_.end());
    return more;
  }
};

TEST_F(TreeplayLargeForest, EveryWayOfCullingDrawsTheSame) {
  std::vector<double> drawn;
  std::string picture;
  for (const char* by : {"flat", "hierarchy", "coherent", "kd", "r"}) {
    const Outcome o = play(with({"--unlit", "--cull", by, "--report", file("r.json")}));
    ASSERT_EQ(o.status, 0) << o.err;
    drawn.push_back(stat(10));
    EXPECT_EQ(reported(read_text(file("r.json")), "culling, the mean of a frame", "", 5), drawn.back());
    const std::string now = read_text(file("f.png"));
    if (picture.empty()) picture = now;
    EXPECT_EQ(now, picture) << by;
  }
  EXPECT_EQ(std::set<double>(drawn.begin(), drawn.end()).size(), 1u);
  EXPECT_GT(drawn[0], 100);
  EXPECT_LT(drawn[0], 3000);
  ASSERT_EQ(play(with({"--unlit", "--cull", "none"})).status, 0);
  EXPECT_EQ(stat(10), 4000);
}

TEST_F(TreeplayLargeForest, OnlyTheBlocksThatAViewNeedsAreRead) {
  ASSERT_EQ(
      play({"--camera", "200,1,399,200,-3,401,20", "--above-ground", "--unlit", "--report", file("r.json")})
          .status,
      0);
  const std::string report = read_text(file("r.json"));
  const std::string table = "instances read from the file";
  EXPECT_EQ(reported(report, table, "instances", 2), 4000);
  EXPECT_LT(reported(report, table, "instances", 1), 1000);
  EXPECT_LT(reported(report, table, "blocks", 1), 0.25 * reported(report, table, "blocks", 2));
  EXPECT_EQ(reported(report, table, "bytes", 1), 24 * reported(report, table, "instances", 1));
}

TEST_F(TreeplayLargeForest, WhatIsFarIsDrawnAsPictures) {
  ASSERT_EQ(play(with({"--unlit"})).status, 0);
  const double pictures = stat(22), triangles = stat(6);
  EXPECT_GT(pictures, 100);
  EXPECT_LT(pictures, stat(10));
  ASSERT_EQ(play(with({"--unlit", "--level", "0"})).status, 0);
  EXPECT_EQ(stat(22), 0);
  EXPECT_LT(triangles, 0.2 * stat(6));
}

// From above: the ground west of a tree is darker with the sun in the east than with the sun in the west, and
// the other way about.
TEST_F(TreeplayForest, ATreeCastsItsShadowAwayFromTheSun) {
  write_text(file("page.json"), R"({"terrain": {"size": [40, 40]},
      "types": [{"name": "rich", "tree": "rich.stree", "instances": [{"x": 20, "z": 20, "scale": 1.5}]}]})");
  ASSERT_EQ(run_process({"ecogen", file("page.json"), "-o", file("f.eco")}).status, 0);
  const auto light = [&](const char* sun, std::size_t first) {
    EXPECT_EQ(play({"--camera", "20,60,20.01,20,0,20,6", "--sun", sun}).status, 0);
    const auto image = read_image(file("f.png"));
    double sum = 0;
    for (std::size_t y = 15; image && y < 17; ++y)
      for (std::size_t x = first; x < first + 3; ++x) sum += image->rgba[4 * (y * 48 + x) + 1];
    return sum;
  };
  EXPECT_LT(light("90,45", 10), 0.9 * light("-90,45", 10));
  EXPECT_LT(light("-90,45", 35), 0.9 * light("90,45", 35));
}

TEST_F(TreeplayForest, WhatIsBeyondItsViewRangeCastsNoShadow) {
  const auto cast = [&](const char* range) {
    write_text(file("page.json"), std::string(R"({"terrain": {"size": [40, 40]},
      "types": [{"name": "rich", "tree": "rich.stree", "view_range": )") +
                                      range + R"(, "instances": [{"x": 20, "z": 20}]}]})");
    EXPECT_EQ(run_process({"ecogen", file("page.json"), "-o", file("f.eco")}).status, 0);
    EXPECT_EQ(play({"--camera", "20,60,20.01,20,0,20,20", "--level", "0"}).status, 0);
    return stat(23);
  };
  const double seen = cast("80");
  EXPECT_EQ(stat(10), 1);
  const double unseen = cast("30");
  EXPECT_EQ(stat(10), 0);
  EXPECT_LT(unseen, seen);
}

TEST_F(TreeplayForest, ASunThatStandsLowerThanTheFileWasMadeForIsWarnedOf) {
  write_text(
      file("path.json"),
      R"({"schema":"copse.path/1","keys":[{"time":0,"eye":[20,5,60],"target":[20,2,20]},{"time":1,"eye":[20,5,60],"target":[20,2,21]}]})");
  ASSERT_EQ(run_process({"ecogen", file("page.json"), "-o", file("f.eco"), "--camera-path", file("path.json"),
                         "--lowest-sun", "40"})
                .status,
            0);
  const std::string warning = "degrees high, and trees whose shadows";
  const auto told = [&](Strings more) {
    more.insert(more.end(), {"--camera", "20,5,60,20,2,20,40"});
    const Outcome o = play(more);
    EXPECT_EQ(o.status, 0) << o.err;
    return o.err.find(warning) != std::string::npos;
  };
  EXPECT_TRUE(told({"--sun", "90,30"}));
  EXPECT_FALSE(told({"--sun", "90,40"}));
  EXPECT_FALSE(told({"--sun", "90,30", "--unlit"}));
}

TEST_F(TreeplayForest, AFrameThatIsWiderThanTheFileWasMadeForIsWarnedOf) {
  write_text(
      file("path.json"),
      R"({"schema":"copse.path/1","keys":[{"time":0,"eye":[20,5,60],"target":[20,2,20]},{"time":1,"eye":[20,5,60],"target":[20,2,21]}]})");
  const auto told = [&](const std::string& widest, const std::string& size) {
    EXPECT_EQ(run_process({"ecogen", file("page.json"), "-o", file("f.eco"), "--camera-path",
                           file("path.json"), "--widest", widest})
                  .status,
              0);
    const Outcome o = run_process({"treeplay", file("f.eco"), "--size", size, "--samples", "1", "--unlit",
                                   "--frames", file("f.png"), "--path", file("path.json"), "--count", "1"});
    EXPECT_EQ(o.status, 0) << o.err;
    return o.err.find("make it with --widest 4") != std::string::npos;
  };
  EXPECT_TRUE(told("2", "64x16"));
  EXPECT_FALSE(told("2", "32x16"));
  EXPECT_FALSE(told("4", "64x16"));
}

// What the sky's light takes of a tree does not depend on what else is in the file.
TEST_F(TreeplayForest, TheSkysLightIsThatOfTheTreesInAnyOrder) {
  std::vector<Image> pictures;
  for (const bool other_first : {false, true}) {
    const std::string trees =
        R"({"name": "rich", "tree": "rich.stree", "instances": [{"x": 15, "z": 20}, {"x": 20, "z": 22}]})";
    const std::string others =
        R"({"name": "other", "tree": "rich.stree", "instances": [{"x": 25, "z": 20}, {"x": 21, "z": 15}]})";
    write_text(file("page.json"), R"({"terrain": {"size": [40, 40]}, "types": [)" +
                                      (other_first ? others + "," + trees : trees + "," + others) + "]}");
    ASSERT_EQ(run_process({"ecogen", file("page.json"), "-o", file("f.eco")}).status, 0);
    ASSERT_EQ(play({"--camera", "20,6,34,20,1,20,30", "--level", "0"}).status, 0);
    auto picture = read_image(file("f.png"));
    ASSERT_TRUE(picture);
    pictures.push_back(std::move(*picture));
  }
  for (std::size_t i = 0; i < pictures[0].rgba.size(); ++i)
    ASSERT_NEAR(pictures[0].rgba[i], pictures[1].rgba[i], 1) << i;
}

TEST_F(TreeplayLargeForest, ATreeThatHasChangedIsToldWithBothHashes) {
  ASSERT_EQ(run_process({"treedump", file("f.eco"), "--verify"}).status, 0);
  std::filesystem::copy_file(file("rich.stree"), file("far.stree"),
                             std::filesystem::copy_options::overwrite_existing);
  const Outcome o = play(with({"--unlit"}));
  EXPECT_EQ(o.status, 0);
  EXPECT_EQ(line_count(o.err), 1u) << o.err;
  EXPECT_NE(o.err.find("far.stree: is not the file that the ecosystem was made with: hash xxh3:"),
            std::string::npos)
      << o.err;
  const Outcome v = run_process({"treedump", file("f.eco"), "--verify"});
  EXPECT_EQ(v.status, 1);
  EXPECT_NE((v.out + v.err).find("far.stree"), std::string::npos);
}

TEST_F(TreeplayLargeForest, DamagedInstancesAreRefusedWhenTheyAreSeen) {
  std::string bytes = read_text(file("f.eco"));
  // The highest bit of every position is unused.
  const auto file_of = EcosystemFile::open(file("f.eco"));
  const SectionInfo* section = file_of->container().find("EINS");
  for (std::size_t i = section->offset + 7; i < section->offset + section->stored_size; i += 24)
    bytes[i] = static_cast<char>(bytes[i] | 0x80);
  write_text(file("f.eco"), bytes);
  const Outcome o = play(with({"--unlit"}));
  EXPECT_EQ(o.status, 1);
  EXPECT_EQ(line_count(o.err), 1u) << o.err;
  EXPECT_NE(o.err.find("block "), std::string::npos) << o.err;
  EXPECT_FALSE(std::filesystem::exists(file("f.png")));
}

// A bit that leaves a sound instance elsewhere, and a checksum of the section that is not looked at.
TEST_F(TreeplayLargeForest, InstancesThatAreNotThoseThatWereWrittenAreRefusedWhenTheyAreSeen) {
  std::string bytes = read_text(file("f.eco"));
  const auto file_of = EcosystemFile::open(file("f.eco"));
  const SectionInfo* section = file_of->container().find("EINS");
  for (std::size_t i = section->offset; i < section->offset + section->stored_size; i += 24)
    bytes[i] = static_cast<char>(bytes[i] ^ 0x10);
  write_text(file("f.eco"), bytes);
  const Outcome o = play(with({"--unlit"}));
  EXPECT_EQ(o.status, 1);
  EXPECT_NE(o.err.find("its instances are damaged"), std::string::npos) << o.err;
  const Outcome v = run_process({"treedump", file("f.eco"), "--verify"});
  EXPECT_EQ(v.status, 1);
  EXPECT_NE((v.out + v.err).find("EHSH"), std::string::npos) << v.out;
}

TEST_F(TreeplayLargeForest, CompressedInstancesAreDrawnAsWell) {
  ASSERT_EQ(play(with({"--unlit"})).status, 0);
  const std::string picture = read_text(file("f.png"));
  make("far.stree", {"--compress"});
  ASSERT_EQ(play(with({"--unlit"})).status, 0);
  EXPECT_EQ(read_text(file("f.png")), picture);
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

TEST_F(TreeplayForest, WhatItCannotShowItSaysBeforeItReadsATree) {
  std::filesystem::remove(file("rich.stree"));
  for (const Strings& wish :
       {Strings{"--show", "skeleton"}, {"--level", "2"}, {"--ratio", "0.5"}, {"--lod", "foliage"}}) {
    const Outcome o = play(wish);
    EXPECT_EQ(o.status, 2);
    EXPECT_NE(o.err.find("is an ecosystem"), std::string::npos) << o.err;
    EXPECT_EQ(line_count(o.err), 1u);
  }
  const Outcome o = play({"--cull", "kd"});
  EXPECT_EQ(o.status, 2);
  EXPECT_NE(o.err.find("block_trees"), std::string::npos) << o.err;
  EXPECT_EQ(play({"--above-ground"}).status, 2);
  EXPECT_EQ(play({}).status, 3);
}

}  // namespace
}  // namespace copse
