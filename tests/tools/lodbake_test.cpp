#include "lib/formats/import/image.h"
#include "lib/formats/levels/foliage_cells.h"
#include "lib/formats/tree_file/tree_file.h"
#include "tests/formats/tampering.h"
#include "tests/tools/baked_oak.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace copse {
namespace {

using Lodbake = BakedOak;

TEST_F(Lodbake, EveryLevelCanBeTakenFromTheFile) {
  const Outcome o = bake({"--discrete", "0.66,0.25,0.1", "--continuous"});
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(o.err, "");
  const std::size_t full = triangles({});
  EXPECT_EQ(full, 8u * 2 * 11 + 60);
  EXPECT_EQ(triangles({"--level", "0"}), full);
  std::size_t before = full;
  for (const char* level : {"1", "2", "3"}) {
    const std::size_t now = triangles({"--level", level});
    EXPECT_LT(now, before);
    EXPECT_GT(now, 0u);
    before = now;
  }
  for (const double ratio : {0.9, 0.5, 0.2, 0.1, 0.05}) {
    const std::size_t now = triangles({"--ratio", std::to_string(ratio)});
    EXPECT_LE(static_cast<double>(now), ratio * static_cast<double>(full)) << ratio;
  }
  EXPECT_EQ(triangles({"--max-error", "0"}), full);
  EXPECT_LT(triangles({"--max-error", "100"}), full / 10);
}

TEST_F(Lodbake, TheTrunkOfAStillTreeGoesByEdges) {
  const std::string still = folder_.file("oak.tree");
  ASSERT_EQ(run_process({"treeprep", folder_.file("oak.obj"), "-o", still, "-q"}).status, 0);
  out_ = folder_.file("oak.lod.tree");
  const Outcome o = run_process({"lodbake", still, "-o", out_, "--discrete", "0.5,0.2", "--continuous"});
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_NE(o.err.find("goes by edges"), std::string::npos) << o.err;
  EXPECT_LE(triangles({"--level", "2"}), 236u / 5);
  EXPECT_EQ(run_process({"treedump", out_, "--verify", "-q"}).status, 0);
}

TEST_F(Lodbake, ATrunkOfManyTubesLeavesLeavesToSmallLevelsByEdgesToo) {
  const std::string still = folder_.file("tubes.tree"), report = folder_.file("report.json");
  ASSERT_EQ(run_process({"treegrow", "birch", "--triangles", "6000", "--no-textures", "-o",
                         folder_.file("tubes.obj"), "-q"})
                .status,
            0);
  ASSERT_EQ(run_process({"treeprep", folder_.file("tubes.obj"), "-o", still, "-q"}).status, 0);
  const Outcome o = run_process({"lodbake", still, "-o", folder_.file("tubes.lod.tree"), "--discrete", "0.1",
                                 "--divide", "even", "--encode", "small", "--report", report});
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(o.err.find("not to be had"), std::string::npos) << o.err;
  const auto page = nlohmann::json::parse(read_text(report));
  for (const auto& table : page["tables"]) {
    if (table["name"] != "levels") continue;
    const double all = std::stod(table["rows"][0][4].get<std::string>()),
                 left = std::stod(table["rows"][1][4].get<std::string>());
    EXPECT_GT(left, 0.02 * all) << "a triangle or two without pieces that go";
    EXPECT_LE(std::stod(table["rows"][1][1].get<std::string>()),
              0.1 * std::stod(table["rows"][0][1].get<std::string>()));
    EXPECT_EQ(table["rows"][1][7], "0") << "floating leaves";
  }
}

TEST_F(Lodbake, ATreeOfOnePartHasTheTrianglesThatItSays) {
  write_text(folder_.path() / "bare.obj", little_tree_obj(40, 12, 0));
  ASSERT_EQ(run_process({"treeprep", folder_.file("bare.obj"), "-o", tree_, "-q"}).status, 0);
  ASSERT_EQ(bake({"--discrete", "0.5,0.1", "--continuous"}).status, 0);
  const auto levels = nlohmann::json::parse(run_process({"treedump", out_, "--json"}).out)["levels"];
  const std::size_t full = triangles({});
  for (const std::size_t i : {0u, 1u}) {
    const std::size_t said = levels["discrete"][i]["triangles"];
    EXPECT_EQ(triangles({"--level", std::to_string(i + 1)}), said) << i;
  }
  for (const double ratio : {0.7, 0.33, 0.1, 0.04})
    EXPECT_LE(double(triangles({"--ratio", std::to_string(ratio)})), ratio * double(full)) << ratio;
}

TEST_F(Lodbake, WithoutContinuousTheFileHasWhatTheDiscreteLevelsNeedAndNoMore) {
  ASSERT_EQ(bake({"--discrete", "0.5,0.2", "--continuous"}).status, 0);
  const auto everything = std::filesystem::file_size(out_);
  const std::size_t first = triangles({"--level", "1"}), second = triangles({"--level", "2"});
  ASSERT_EQ(bake({"--discrete", "0.5,0.2"}).status, 0);
  EXPECT_LT(std::filesystem::file_size(out_), everything);
  EXPECT_EQ(triangles({"--level", "1"}), first);
  EXPECT_EQ(triangles({"--level", "2"}), second);
  EXPECT_EQ(triangles({"--ratio", "0.4"}), second) << "the finest level within";
  const Outcome o = run_process({"treedump", out_, "--export", folder_.file("x.obj"), "--ratio", "0.01"});
  EXPECT_EQ(o.status, 1);
  EXPECT_NE(o.err.find("--continuous"), std::string::npos) << o.err;
}

TEST_F(Lodbake, AMeshIsToldToGoThroughTreeprep) {
  const Outcome o = run_process({"lodbake", folder_.file("oak.obj"), "-o", out_});
  EXPECT_EQ(o.status, 1);
  EXPECT_EQ(line_count(o.err), 1u);
  EXPECT_NE(o.err.find("treeprep " + folder_.file("oak.obj")), std::string::npos) << o.err;
}

TEST_F(Lodbake, TreedumpListsTheLevelsAndTheSpectra) {
  ASSERT_EQ(bake({"--discrete", "0.5,0.2", "--continuous"}).status, 0);
  const std::string text = run_process({"treedump", out_}).out;
  for (const char* part : {"0: 236 triangles, full detail", "hysteresis 10 %", "trunk by radii",
                           "leaves by leaf collapses", "every level in between"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  const auto json = nlohmann::json::parse(run_process({"treedump", out_, "--json"}).out);
  ASSERT_EQ(json["levels"]["discrete"].size(), 2u);
  EXPECT_LE(json["levels"]["discrete"][1]["share"], 0.2);
  EXPECT_EQ(json["levels"]["spectra"][0]["method"], "radii");
}

TEST_F(Lodbake, AnImpostorIsBakedMeasuredListedExportedAndLeftOutAgain) {
  ASSERT_EQ(
      bake({"--impostor", "32", "--impostor-views", "4", "--views", "12", "--report", folder_.file("r.json")})
          .status,
      0);
  double iou = 0;
  const auto json = nlohmann::json::parse(read_text(folder_.path() / "r.json"));
  for (const auto& table : json["tables"])
    if (table["name"] == "impostor") iou = std::stod(table["rows"][0][5].get<std::string>());
  EXPECT_GT(iou, 0.4);
  EXPECT_NE(run_process({"treedump", out_}).out.find("16 views from everywhere of 32 x 32 pixels"),
            std::string::npos);
  ASSERT_EQ(run_process({"treedump", out_, "--export", folder_.file("atlas.png")}).status, 0);
  for (const char* name : {"atlas.png", "atlas.normal.png"}) {
    const auto image = read_image(folder_.path() / name);
    ASSERT_TRUE(image.has_value()) << name;
    EXPECT_EQ(image->width, 128);
    EXPECT_EQ(image->height, 128);
    EXPECT_TRUE(image->has_alpha);
  }
  EXPECT_EQ(run_process({"treedump", out_, "--verify", "-q"}).status, 0);
  const std::string baked = out_;
  ASSERT_EQ(run_process({"lodbake", baked, "-o", folder_.file("again.stree")}).status, 0);
  EXPECT_EQ(run_process({"treedump", folder_.file("again.stree"), "--export", folder_.file("no.png")}).status,
            1);
}

TEST_F(Lodbake, NearMediumAndFarAreWhereTheThreeModelsChange) {
  ASSERT_EQ(bake({"--near", "100", "--medium", "500", "--far", "1500"}).status, 0);
  const auto levels = nlohmann::json::parse(run_process({"treedump", out_, "--json"}).out)["levels"];
  EXPECT_EQ(levels["near"], 100);
  ASSERT_EQ(levels["discrete"].size(), 2u);
  EXPECT_EQ(levels["discrete"][0]["distance"], 500);
  EXPECT_EQ(levels["discrete"][1]["distance"], 1500);
  EXPECT_LE(levels["discrete"][0]["share"], 0.5);
  EXPECT_LE(levels["discrete"][1]["share"], 0.25);
}

TEST_F(Lodbake, ATreeBelowTheThresholdGetsNoLevels) {
  ASSERT_EQ(bake({"--threshold", "235"}).status, 0);
  EXPECT_TRUE(TreeFile::open(out_)->has("LSLD"));
  const Outcome o = bake({"--threshold", "236", "--report", folder_.file("r.json")});
  EXPECT_EQ(o.status, 0);
  EXPECT_NE(o.err.find("without levels"), std::string::npos) << o.err;
  EXPECT_EQ(read_text(out_), read_text(tree_));
}

TEST_F(Lodbake, RingsGoInTheOrderThatIsAskedFor) {
  for (const char* order : {"silhouette", "angle", "projected-angle", "diameter"}) {
    ASSERT_EQ(bake({"--removal", order, "--continuous"}).status, 0) << order;
    EXPECT_LE(triangles({"--ratio", "0.2"}), 236u / 5) << order;
  }
  EXPECT_EQ(bake({"--removal", "magic"}).status, 2);
}

TEST_F(Lodbake, TheEstimatesOfLinesAndPointsStayBelowTheThesis) {
  const std::string mesh = folder_.file("bush.glb"), report = folder_.file("r.json");
  ASSERT_EQ(run_process({"treegrow", "bush", "-o", mesh, "--triangles", "2000", "-q"}).status, 0);
  ASSERT_EQ(run_process({"treeprep", mesh, "-o", tree_, "-q"}).status, 0);
  ASSERT_EQ(bake({"--lines-points", "--views", "12", "--report", report}).status, 0);
  const auto json = nlohmann::json::parse(read_text(report));
  int found = 0;
  for (const auto& e : json["errors"]) {
    if (!e["name"].get<std::string>().starts_with("projected")) continue;
    ++found;
    EXPECT_LT(e["value"], 0.15) << e["name"];
  }
  EXPECT_EQ(found, 3);
}

TEST_F(Lodbake, TheTreeItselfIsCopiedUntouched) {
  ASSERT_EQ(bake({}).status, 0);
  const Outcome diff = run_process({"treedump", tree_, out_, "--diff", "-q"});
  EXPECT_EQ(diff.out,
            "LSTR (level-of-detail spectrum of the trunk): only in the second file\n"
            "LSLV (level-of-detail spectrum of the leaves): only in the second file\n"
            "LSLD (levels of detail): only in the second file\n")
      << diff.err;
  EXPECT_EQ(run_process({"treedump", out_, "--verify", "-q"}).status, 0);
}

TEST_F(Lodbake, DiffTellsOtherLevelsApart) {
  ASSERT_EQ(bake({"--discrete", "0.5,0.1", "--continuous"}).status, 0);
  const std::string before = folder_.file("before.stree");
  std::filesystem::rename(out_, before);
  ASSERT_EQ(bake({"--discrete", "0.4,0.1", "--continuous"}).status, 0);
  const Outcome diff = run_process({"treedump", before, out_, "--diff", "-q"});
  EXPECT_EQ(diff.status, 1);
  EXPECT_NE(diff.out.find("LSLD (levels of detail): "), std::string::npos) << diff.out;
  EXPECT_NE(diff.out.find("bytes differ"), std::string::npos) << diff.out;
}

TEST_F(Lodbake, TheSameBytesEveryTimeAndForEveryNumberOfThreads) {
  ASSERT_EQ(bake({"--discrete", "0.5,0.1", "-j", "1"}).status, 0);
  const std::string first = read_text(out_);
  ASSERT_EQ(bake({"--discrete", "0.5,0.1", "-j", "4"}).status, 0);
  EXPECT_EQ(read_text(out_), first);
}

TEST_F(Lodbake, SmallIsSmallerAndSaysHowWrongItIs) {
  ASSERT_EQ(bake({"--discrete", "0.5"}).status, 0);
  const auto fast = std::filesystem::file_size(out_);
  ASSERT_EQ(bake({"--discrete", "0.5", "--encode", "small", "--report", folder_.file("r.json")}).status, 0);
  EXPECT_LT(std::filesystem::file_size(out_), fast);
  const auto report = nlohmann::json::parse(read_text(folder_.path() / "r.json"));
  double error = -1;
  for (const auto& e : report["errors"])
    if (e["name"] == "packing of the trunk, largest") error = e["value"];
  EXPECT_GT(error, 0);
  EXPECT_LT(error, 0.01);
  EXPECT_GT(triangles({"--level", "1"}), 0u);
}

TEST_F(Lodbake, AGlbCarriesEveryLevelAndShowsTheFirst) {
  ASSERT_EQ(bake({"--discrete", "0.5,0.2"}).status, 0);
  EXPECT_EQ(triangles({}, "all.glb"), 8u * 2 * 11 + 60);  // what the scene shows is full detail
  const std::string text = read_text(folder_.path() / "all.glb");
  const auto begin = text.find('{'), end = text.find("BIN");
  const auto json = nlohmann::json::parse(text.substr(begin, text.rfind('}', end) - begin + 1));
  EXPECT_EQ(json["extensionsUsed"][0], "MSFT_lod");
  const std::size_t root = json["scenes"][0]["nodes"][0];
  const auto ids = json["nodes"][root]["extensions"]["MSFT_lod"]["ids"];
  ASSERT_EQ(ids.size(), 2u);
  for (const std::size_t id : ids) EXPECT_TRUE(json["nodes"][id].contains("children"));
  EXPECT_EQ(json["nodes"][root]["extras"]["MSFT_screencoverage"].size(), 3u);
  EXPECT_LT(triangles({"--level", "1"}, "one.glb"), 8u * 2 * 11 + 60);
}

TEST_F(Lodbake, AGlbEndsInTheImpostorAsTwoPictures) {
  ASSERT_EQ(bake({"--discrete", "0.5", "--impostor", "32", "--impostor-views", "4"}).status, 0);
  EXPECT_EQ(triangles({}, "all.glb"), 8u * 2 * 11 + 60);
  const std::string text = read_text(folder_.path() / "all.glb");
  const auto begin = text.find('{'), end = text.find("BIN");
  const auto json = nlohmann::json::parse(text.substr(begin, text.rfind('}', end) - begin + 1));
  const std::size_t root = json["scenes"][0]["nodes"][0];
  const auto ids = json["nodes"][root]["extensions"]["MSFT_lod"]["ids"];
  ASSERT_EQ(ids.size(), 2u);  // a level and the impostor
  const auto coverage = json["nodes"][root]["extras"]["MSFT_screencoverage"];
  ASSERT_EQ(coverage.size(), 3u);
  EXPECT_GT(coverage[0], coverage[1]);
  const std::size_t child = json["nodes"][ids[1].get<std::size_t>()]["children"][0];
  const auto primitive = json["meshes"][json["nodes"][child]["mesh"].get<std::size_t>()]["primitives"][0];
  EXPECT_EQ(json["accessors"][primitive["indices"].get<std::size_t>()]["count"], 12);  // two quads
  const auto material = json["materials"][primitive["material"].get<std::size_t>()];
  EXPECT_EQ(material["alphaMode"], "MASK");
  EXPECT_TRUE(material["doubleSided"].get<bool>());
  const auto& base = material["pbrMetallicRoughness"];
  EXPECT_TRUE(base.contains("baseColorTexture"));
}

TEST_F(Lodbake, WrongOptionsAreUsageErrors) {
  for (const std::vector<std::string>& wrong :
       std::vector<std::vector<std::string>>{{"--discrete", "0.2,0.5"},
                                             {"--discrete", "1.5"},
                                             {"--discrete-error", "0.5,0.1"},
                                             {"--near", "500", "--medium", "100"},
                                             {"--near", "100", "--far", "110"},
                                             {"--hysteresis", "100"},
                                             {"--far", "0"},
                                             {"--near", "0", "--continuous"},
                                             {"--near", "0", "--foliage", "prune"},
                                             {"--near", "10", "--far", "100", "--discrete", "0.5"},
                                             {"--near", "10", "--far", "14", "--discrete", "0.5,0.3,0.1"},
                                             {"--hysteresis", "99", "--discrete", "0.9,.8,.7,.6,.5,.4,.3"},
                                             {"--impostor-views", "4"},
                                             {"--impostor-layout", "billboard"},
                                             {"--min-triangles", "-1"},
                                             {"--threshold", "-1"},
                                             {"--medium", "50", "--discrete", "0.5"},
                                             {"--method", "radii,edges"},
                                             {"--method", "collapse,prune"},
                                             {"--method", "edges", "--trunk", "radii"},
                                             {"--method", "lines-points", "--discrete", "0.5"},
                                             {"--foliage", "prune", "--quality", "fast"},
                                             {"--trunk", "magic"},
                                             {"--position-bits", "3"}}) {
    const Outcome o = bake(wrong);
    EXPECT_EQ(o.status, 2) << wrong[0] << ": " << o.err;
    EXPECT_FALSE(std::filesystem::exists(out_));
  }
  EXPECT_EQ(run_process({"lodbake", tree_, "-o", folder_.file("oak.tree")}).status, 2);
}

TEST_F(Lodbake, ADamagedSpectrumIsRefused) {
  ASSERT_EQ(bake({}).status, 0);
  std::string text = read_text(out_);
  std::vector<std::uint8_t> bytes(text.begin(), text.end());
  bytes[tampering::section_at(bytes, "LSTR") + 40] ^= 0x10;
  std::ofstream(out_, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  const Outcome o = run_process({"treedump", out_, "--export", folder_.file("x.obj"), "--ratio", "0.5"});
  EXPECT_EQ(o.status, 1);
  EXPECT_EQ(line_count(o.err), 1u);
  EXPECT_NE(o.err.find("LSTR"), std::string::npos) << o.err;
}

TEST_F(Lodbake, PrunedFoliageComesWithItsCells) {
  ASSERT_EQ(bake({"--foliage", "prune", "--cells", "8", "--views", "12", "--discrete", "0.3"}).status, 0);
  const auto file = TreeFile::open(out_);
  ASSERT_TRUE(file.has_value());
  for (const char* section : {"FCEL", "FORD", "FVIS", "FPAR"}) EXPECT_TRUE(file->has(section)) << section;
  EXPECT_LE(triangles({"--level", "1"}), (8u * 2 * 11 + 60) * 3 / 10);
}

TEST_F(Lodbake, WhatARuntimeMakesOfCellsIsSetAndStored) {
  const Outcome o =
      bake({"--foliage=prune", "--views=12", "--near=3", "--far=30", "--prune-ramp=power", "--prune-half=3",
            "--prune-least=0.2", "--prune-growth=9", "--prune-distance=tree", "--prune-compensation=total"});
  ASSERT_EQ(o.status, 0) << o.err;
  const auto cells = read_foliage_cells(*TreeFile::open(out_));
  ASSERT_TRUE(cells.has_value());
  const FoliageParameters& p = cells->parameters;
  EXPECT_EQ(p.near, 3);
  EXPECT_EQ(p.far, 30);
  EXPECT_EQ(p.ramp, FoliageParameters::Ramp::power);
  EXPECT_EQ(p.half_distance, 3);
  EXPECT_EQ(p.least, 0.2f);
  EXPECT_EQ(p.largest_enlargement, 9);
  EXPECT_EQ(p.distance, FoliageParameters::Distance::tree);
  EXPECT_EQ(p.compensation, FoliageParameters::Compensation::total);
  EXPECT_EQ(bake({"--prune-least", "0.2"}).status, 2) << "leaves collapse";
}

TEST_F(Lodbake, MethodsHaveNames) {
  ASSERT_EQ(bake({"--method", "edges,prune"}).status, 0);
  const std::string named = read_text(out_);
  ASSERT_EQ(bake({"--trunk", "edges", "--foliage", "prune"}).status, 0);
  EXPECT_EQ(read_text(out_), named);
  EXPECT_EQ(bake({"--method", "magic"}).status, 2);
}

TEST_F(Lodbake, LinesAndPointsAloneBakeNothingElse) {
  const std::string report = folder_.file("r.json");
  ASSERT_EQ(bake({"--method", "lines-points", "--views", "12", "--report", report}).status, 0);
  EXPECT_EQ(read_text(out_), read_text(tree_));
  EXPECT_NE(read_text(report).find("lines and points"), std::string::npos);
  ASSERT_EQ(bake({"--method", "lines-points,radii", "--views", "12"}).status, 0);
  EXPECT_TRUE(TreeFile::open(out_)->has("LSTR"));
}

TEST_F(Lodbake, AnImpostorIsAMethodToo) {
  ASSERT_EQ(
      bake({"--method", "impostor", "--impostor-views", "1", "--impostor", "16", "--views", "12"}).status, 0);
  EXPECT_EQ(bake({"--method", "impostor", "--impostor-views", "2", "--views", "12"}).status, 0);
  EXPECT_NE(run_process({"treedump", out_}).out.find("4 views from everywhere"), std::string::npos);
  EXPECT_EQ(run_process({"treedump", out_, "--export", folder_.file("atlas.png")}).status, 0);
  ASSERT_EQ(bake({"--method", "impostor", "--views", "12"}).status, 0);
  EXPECT_NE(run_process({"treedump", out_}).out.find("128 x 128 pixels"), std::string::npos);
}

TEST_F(Lodbake, SaysWhatIsNotToBeHad) {
  const Outcome twice = bake({"--discrete", "0.5,0.33", "--divide", "even"});
  EXPECT_EQ(twice.status, 0) << twice.err;
  EXPECT_NE(twice.err.find("levels 1 and 2 are the same"), std::string::npos) << twice.err;
  const Outcome cells = bake({"--cells", "12", "--divide", "even"});
  EXPECT_EQ(cells.status, 0);
  EXPECT_NE(cells.err.find("--cells"), std::string::npos) << cells.err;
  const Outcome floor = bake({"--trunk", "edges", "--discrete", "0.01", "--divide", "even"});
  EXPECT_EQ(floor.status, 0);
  EXPECT_NE(floor.err.find("not the 2 that were asked for"), std::string::npos) << floor.err;
}

TEST_F(Lodbake, PrunedLeavesHaveNoFloor) {
  const Outcome o = bake(
      {"--foliage", "prune", "--cells", "60", "--views", "12", "--discrete", "0.05", "--divide", "even"});
  EXPECT_EQ(o.status, 0);
  EXPECT_EQ(o.err.find("asked for"), std::string::npos) << o.err;
  EXPECT_LE(triangles({"--level", "1"}), 11u);
}

TEST_F(Lodbake, ASmallCrownIsPrunedToo) {
  ASSERT_EQ(bake({"--foliage", "prune", "--views", "12", "--discrete", "0.1", "--divide", "even"}).status, 0);
  EXPECT_LE(triangles({"--level", "1"}), 23u);
}

TEST_F(Lodbake, WithoutLinesTheTrunkGoesByEdges) {
  ASSERT_EQ(run_process({"treeprep", folder_.file("oak.obj"), "-o", tree_, "-q", "--omit", "lines"}).status,
            0);
  ASSERT_EQ(bake({"--discrete", "0.25"}).status, 0);
  EXPECT_LE(triangles({"--level", "1"}), 236u / 4);
}

TEST_F(Lodbake, LinesAndPointsNeedTheirSections) {
  EXPECT_EQ(bake({"--lines-points"}).status, 0);
  ASSERT_EQ(run_process({"treeprep", folder_.file("oak.obj"), "-o", tree_, "-q", "--omit", "TACC"}).status,
            0);
  const Outcome o = bake({"--lines-points"});
  EXPECT_EQ(o.status, 1);
  EXPECT_NE(o.err.find("TACC"), std::string::npos) << o.err;
}

TEST_F(Lodbake, ByEdgesItWorksToo) {
  ASSERT_EQ(bake({"--trunk", "edges", "--discrete", "0.5", "--divide", "even"}).status, 0);
  EXPECT_LE(triangles({"--level", "1"}), (8u * 2 * 11 + 60) / 2);
}

TEST_F(Lodbake, ASmallFileDoesAllThatAFastOneDoes) {
  ASSERT_EQ(bake({"--discrete", "0.5,0.2", "--divide", "even"}).status, 0);
  const auto fast = std::filesystem::file_size(out_);
  const std::size_t full = triangles({});
  ASSERT_EQ(bake({"--continuous", "--divide", "even", "--encode", "small"}).status, 0);
  const std::size_t half = triangles({"--ratio", "0.5"}), fifth = triangles({"--ratio", "0.2"});
  EXPECT_LE(half, full / 2);
  EXPECT_LE(fifth, full / 5);
  EXPECT_GT(fifth, full / 8) << "of a spectrum that has levels all along";
  ASSERT_EQ(bake({"--discrete", "0.5,0.2", "--divide", "even", "--encode", "small"}).status, 0);
  EXPECT_LT(8 * std::filesystem::file_size(out_), fast);
  EXPECT_EQ(triangles({}), full);
  EXPECT_EQ(triangles({"--level", "1"}), half) << "the finest within the share that the continuous one has";
  EXPECT_EQ(triangles({"--level", "2"}), fifth);
  const Outcome sound = run_process({"treedump", out_, "--verify"});
  EXPECT_EQ(sound.status, 0) << sound.err;
  const std::string volumes = folder_.file("volumes.stree");
  const Outcome fitted =
      run_process({"bvfit", out_, "-o", volumes, "--per", "groups", "--volumes", "sphere", "-q"});
  EXPECT_EQ(fitted.status, 0) << fitted.err;
  const Outcome held = run_process({"treedump", volumes, "--verify"});
  EXPECT_EQ(held.status, 0) << held.err;
  // Volumes were fitted to the tree as it is packed, so they stay when levels are baked again.
  out_ = folder_.file("again.stree");
  const Outcome again =
      run_process({"lodbake", volumes, "-o", out_, "--encode", "small", "--divide", "even"});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(again.err, "");
  EXPECT_TRUE(TreeFile::open(out_)->container().find("VSET") != nullptr);
}

TEST_F(Lodbake, WarnsThatVolumesAreOfTheTreeBeforeItWasPacked) {
  const std::string volumes = folder_.file("volumes.stree");
  ASSERT_EQ(
      run_process({"bvfit", tree_, "-o", volumes, "--per", "groups", "--volumes", "sphere", "-q"}).status, 0);
  const Outcome o = run_process({"lodbake", volumes, "-o", out_, "--encode", "small", "--divide", "even"});
  EXPECT_EQ(o.status, 0);
  EXPECT_NE(o.err.find("VSET"), std::string::npos) << o.err;
  EXPECT_TRUE(TreeFile::open(out_)->container().find("VSET") == nullptr);
}

}  // namespace
}  // namespace copse
