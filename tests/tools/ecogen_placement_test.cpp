// Where ecogen plants, as a user calls it: cells, maps, spacing, what does not fit.
#include "lib/formats/ecosystem/ecosystem_file.h"
#include "lib/formats/ecosystem/instance_codec.h"
#include "lib/formats/import/image.h"
#include "lib/formats/random.h"
#include "lib/formats/tree_file/tree_file.h"
#include "tests/tools/ecogen_folder.h"

#include <array>
#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace copse {
namespace {

TEST_F(Ecogen, ManyInAMetre) {
  page_["terrain"] = Json{{"size", {1, 1}}};
  page_["types"][0]["count"] = 100000;
  page_["types"][0]["scale"] = 1e-6;
  ASSERT_EQ(run().status, 0);
  EXPECT_EQ(load().instance_count(), 100050u);
}

TEST_F(Ecogen, AOneTriangleTerrainIsPlantedOnTheTriangle) {
  page_["terrain"] = Json::parse(
      R"({"samples": [2, 2], "nurbs": {"degree": [1, 1], "points": [[[0,0,0],[0,0,0]],[[0,0,40],[40,8,40]]]}})");
  ASSERT_EQ(run().status, 0) << run().err;
  const Ecosystem eco = load();
  EXPECT_EQ(eco.instance_count(), 250u);
  for (const InstanceBlock& b : eco.blocks)
    for (std::size_t i = b.first; i < b.first + b.count; ++i) {
      const Double3 p = instance_of(eco, b, i).position;
      EXPECT_LE(p.x, p.z + 1e-3);
      EXPECT_NEAR(p.y, p.x / 5, 1e-4);
    }
}

TEST_F(Ecogen, ByHandBesideAFreeSurfaceStandsAsHighAsItsNearestPartAndIsToldOf) {
  page_["terrain"] = Json::parse(
      R"({"origin": [0, 500, 0], "samples": [2, 2],
          "nurbs": {"degree": [1, 1], "points": [[[0,0,10],[10,5,0]],[[10,0,20],[20,5,10]]]}})");
  for (Json& type : page_["types"]) type["count"] = 0;
  // In the box of the surface and off it; out of the box; on it.
  page_["types"][0]["instances"] =
      Json::parse(R"([{"x": 0.5, "z": 0.5}, {"x": 30, "z": 30}, {"x": 10, "z": 10}])");
  const Outcome o = run();
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_NE(o.err.find("2 by hand stand outside the terrain"), std::string::npos) << o.err;
  const Ecosystem eco = load();
  ASSERT_EQ(eco.instance_count(), 3u);
  for (const InstanceBlock& b : eco.blocks)
    for (std::size_t i = b.first; i < b.first + b.count; ++i) {
      const double y = instance_of(eco, b, i).position.y;
      EXPECT_GE(y, 500 - 1e-3);
      EXPECT_LE(y, 505 + 1e-3);
    }
}

// Two pixels of so many channels, uncompressed, the second one alpha.
std::string grey_tiff(const std::vector<std::uint8_t>& values, std::uint16_t channels) {
  const std::vector<std::array<std::uint32_t, 3>> tags{
      {256, 4, 2},        {257, 4, 1}, {258, 3, 8u | 8u << 16},
      {259, 3, 1},        {262, 3, 1}, {273, 4, 0},
      {277, 3, channels}, {278, 4, 1}, {279, 4, static_cast<std::uint32_t>(values.size())},
      {338, 3, 2}};
  std::string out("II*\0\10\0\0\0", 8);
  const auto put = [&](std::uint32_t v, int bytes) {
    for (int b = 0; b < bytes; ++b) out += static_cast<char>(v >> 8 * b & 255);
  };
  put(static_cast<std::uint32_t>(tags.size()), 2);
  const auto end = static_cast<std::uint32_t>(8 + 2 + 12 * tags.size() + 4);
  for (const auto& [tag, type, value] : tags)
    put(tag, 2), put(type, 2), put(tag == 258 ? channels : 1, 4), put(tag == 273 ? end : value, 4);
  put(0, 4);
  return out + std::string(values.begin(), values.end());
}

TEST_F(Ecogen, MapsOfOddChannelsAndDepthsSteerDensity) {
  // Half of the ground is black, in a PNG of RGBA whose alpha says the opposite.
  Image image{.width = 10, .height = 4, .rgba = std::vector<std::uint8_t>(160), .has_alpha = true};
  for (std::size_t i = 0; i < 40; ++i) {
    const bool west = i % 10 < 5;
    for (std::size_t c = 0; c < 3; ++c) image.rgba[4 * i + c] = west ? 255 : 0;
    image.rgba[4 * i + 3] = west ? 0 : 255;
  }
  for (const char* name : {"m.png", "m.tif", "m.exr"}) {
    ASSERT_TRUE(write_image(file(name), image));
    for (const char* channel : {"r", "a"}) {
      if (std::string(name) == "m.exr" && channel[0] == 'r') continue;  // premultiplied: black everywhere
      page_["types"][0]["density"] = {{"file", name}, {"channel", channel}};
      const Outcome o = run();
      ASSERT_EQ(o.status, 0) << o.err;
      const Ecosystem eco = load();
      for (const InstanceBlock& b : eco.blocks)
        for (std::size_t i = b.first; i < b.first + b.count && eco.types[b.type].name == "a"; ++i)
          EXPECT_EQ(instance_of(eco, b, i).position.x < 30.001, channel[0] == 'r') << name << channel;
    }
  }
  page_["types"][0]["density"] = {{"file", "m.png"}, {"channel", 7}};
  std::filesystem::remove(file("out.eco"));
  EXPECT_NE(refusal().find("has 4 channels, none is '7'"), std::string::npos);
  // Grey with alpha has no green, and its alpha is not taken for it.
  write_text(file("grey.tif"), grey_tiff({255, 0, 0, 255}, 2));
  for (const char* channel : {"r", "y", "a", "g"}) {
    page_["types"][0]["density"] = {{"file", "grey.tif"}, {"channel", channel}};
    if (channel[0] == 'g') {
      std::filesystem::remove(file("out.eco"));
      EXPECT_NE(refusal().find("has 2 channels, grey (y or r) and alpha (a), none is 'g'"),
                std::string::npos);
      break;
    }
    ASSERT_EQ(run().status, 0);
    const Ecosystem eco = load();
    for (const InstanceBlock& b : eco.blocks)
      for (std::size_t i = b.first; i < b.first + b.count && eco.types[b.type].name == "a"; ++i)
        EXPECT_EQ(instance_of(eco, b, i).position.x < 30.001, channel[0] != 'a') << channel;
  }
  page_["types"][0]["density"] = "page.json";
  EXPECT_NE(refusal().find("page.json"), std::string::npos);
}

// Where only one of the types has its clusters it gets all of the mix: what is shared out is what is planted.
TEST_F(Ecogen, AMixWithClustersIsSharedOutByTheClustersThatItIsPlantedBy) {
  const auto half = [&](const char* name, bool west) {
    Image image{.width = 64, .height = 64, .rgba = std::vector<std::uint8_t>(4 * 64 * 64, 255)};
    for (std::size_t i = 0; i < 64 * 64; ++i)
      for (std::size_t c = 0; c < 3; ++c) image.rgba[4 * i + c] = (i % 64 < 32) == west ? 255 : 0;
    ASSERT_TRUE(write_image(file(name), image));
  };
  half("west.png", true), half("east.png", false);
  for (auto& t : page_["types"]) t.erase("count"), t["clusters"] = {{"count", 6}, {"radius", 4}};
  page_["mixes"] = Json::parse(R"([{"count": 500, "parts": [{"type": "a", "share": "west.png"},
                                                             {"type": "b", "share": "east.png"}]}])");
  for (int seed = 0; seed < 6; ++seed) {
    page_["seed"] = seed;
    const Outcome o = run();
    ASSERT_EQ(o.status, 0) << o.err;
    EXPECT_EQ(load().instance_count(), 500u);
  }
}

// However many types share it, a mix is looked at once.
TEST_F(Ecogen, TheReportTellsAtHowManyPointsAMixWasLookedAt) {
  const Image image{.width = 64, .height = 64, .rgba = std::vector<std::uint8_t>(4 * 64 * 64, 255)};
  ASSERT_TRUE(write_image(file("even.png"), image));
  for (auto& t : page_["types"]) t.erase("count");
  Json& mix = page_["mixes"][0] =
      Json::parse(R"({"count": 500, "parts": [{"type": "a", "share": "even.png"}]})");
  for (const char* types : {"1", "2"}) {
    if (*types == '2') mix["parts"].push_back({{"type", "b"}, {"share", "even.png"}});
    ASSERT_EQ(run({"--report", file("r.json")}).status, 0);
    const Json report = Json::parse(read_text(file("r.json")));
    Json rows;
    for (const Json& table : report["tables"])
      if (table["name"] == "mixes") rows = table["rows"];
    EXPECT_EQ(rows, Json({{"mixes[0]", types, "500", "128", "16384"}}));
  }
}

// By itself the footprint is what the crown reaches when it is turned: one that leans reaches farther.
TEST_F(Ecogen, TheCrownsReachCountsTurningAndLeaning) {
  page_["types"].erase(1);
  page_["types"][0].erase("tilt");
  const auto box = TreeFile::open(file("a.stree"))->header().bounds;
  const double x = std::max(std::abs(double{box.min.x}), std::abs(double{box.max.x})),
               z = std::max(std::abs(double{box.min.z}), std::abs(double{box.max.z}));
  // 200 in cells of 60 / 18 by 40 / 12 m, upright: the corner of the box just fits, or just does not.
  const double fits = 40 / 12.0 / 2 / std::hypot(x, z);
  page_["types"][0]["scale"] = 0.999 * fits;
  EXPECT_EQ(run().err.find("larger than their cell"), std::string::npos);
  page_["types"][0]["tilt"] = {{"pitch", 10}};
  EXPECT_NE(run().err.find("200 of 200 are larger than their cell"), std::string::npos);
  page_["types"][0].erase("tilt");
  page_["types"][0]["scale"] = 1.001 * fits;
  EXPECT_NE(run().err.find("200 of 200 are larger than their cell"), std::string::npos);
}

// What touches what is a matter of the trees as stored: of their boxes' corners, scaled, turned and leaned.
TEST_F(Ecogen, CrownsKeptInTheirCellsNeverTouchUnderAnyMapRangeAndTilt) {
  page_["types"].erase(1);
  page_["types"][0]["count"] = 150;
  page_["terrain"]["faults"]["first"] = 2;
  Image image{.width = 9, .height = 7, .rgba = std::vector<std::uint8_t>(4 * 63, 255)};
  for (std::size_t i = 0; i < 63; ++i)
    for (std::size_t c = 0; c < 3; ++c) image.rgba[4 * i + c] = static_cast<std::uint8_t>(i * i * 37 % 256);
  ASSERT_TRUE(write_image(file("s.png"), image));
  int touching = 0, crowded = 0, kept = 0;
  for (int k = 0; k < 12; ++k) {
    Json& type = page_["types"][0];
    type["scale"] = {{"min", 0.002 + 0.003 * k}, {"max", 0.03 + 0.01 * k}};
    type.erase("scale_map");
    if (k % 2 == 0) type["scale_map"] = "s.png";
    type["tilt"] = k % 3 == 0 ? Json("terrain") : Json{{"pitch", 8 * k}, {"roll", k % 3 == 1 ? 0 : 5}};
    page_["seed"] = k;
    ASSERT_EQ(run({"--report", file("r.json")}).status, 0);
    const Json report = Json::parse(read_text(file("r.json")));
    for (const auto& table : report["tables"])
      if (table["name"] == "types") crowded = std::stoi(table["rows"][0][4].get<std::string>());
    if (crowded > 0) continue;  // no promise
    ++kept;
    const Ecosystem eco = load();
    std::vector<std::array<double, 3>> discs;  // x, z, how far the crown reaches
    for (const InstanceBlock& b : eco.blocks)
      for (std::size_t i = b.first; i < b.first + b.count; ++i) {
        const Instance s = instance_of(eco, b, i);
        const FloatBox& box = eco.types[s.type].bounds;
        double reach = 0;
        for (int corner = 0; corner < 8; ++corner) {
          const Double3 p{double{corner & 1 ? box.max.x : box.min.x},
                          double{corner & 2 ? box.max.y : box.min.y},
                          double{corner & 4 ? box.max.z : box.min.z}};
          const Double3 q = rotate(s.rotation, p) * s.scale;
          reach = std::max(reach, std::hypot(q.x, q.z));
        }
        discs.push_back({s.position.x, s.position.z, reach});
      }
    for (std::size_t i = 0; i < discs.size(); ++i)
      for (std::size_t n = 0; n < i; ++n)
        touching += std::hypot(discs[i][0] - discs[n][0], discs[i][1] - discs[n][1]) <
                    discs[i][2] + discs[n][2] - 1e-3;
  }
  EXPECT_EQ(touching, 0);
  EXPECT_GE(kept, 3);
}

TEST_F(Ecogen, WhereTheGroundIsTooFullForADensityItSaysSo) {
  Image image{.width = 2, .height = 1, .rgba = {85, 85, 85, 255, 255, 255, 255, 255}};
  ASSERT_TRUE(write_image(file("d.png"), image));
  page_["types"].erase(1);
  page_["types"][0].merge_patch(
      Json::parse(R"({"count": 800, "scale": 1, "density": "d.png", "spacing": 0.5})"));
  const auto east = [&] {
    const Ecosystem eco = load();
    int n = 0;
    for (const InstanceBlock& b : eco.blocks)
      for (std::size_t i = b.first; i < b.first + b.count; ++i) n += instance_of(eco, b, i).position.x >= 30;
    return n;
  };
  const Outcome room =
      run({"--report", file("r.json")});  // discs fill 0.26 of the ground, 0.39 of its denser half
  ASSERT_EQ(room.status, 0) << room.err;
  EXPECT_NEAR(east(), 600, 12);
  EXPECT_EQ(room.err.find("the ground is full"), std::string::npos) << room.err;
  EXPECT_NE(read_text(file("r.json")).find("density and spacing"), std::string::npos);
  page_["types"][0]["count"] = 1400;
  const Outcome full = run();
  ASSERT_EQ(full.status, 0) << full.err;
  EXPECT_EQ(load().instance_count(), 1400u);
  EXPECT_LT(east(), 1000);
  EXPECT_NE(full.err.find("types[0] (a): where its density is highest the ground is full: "),
            std::string::npos)
      << full.err;
  EXPECT_NE(full.err.find(" 1050 are asked for"), std::string::npos) << full.err;
}

// Maps whose pixels are smaller than a few pieces of the density, and feet that are in the way.
TEST_F(Ecogen, WhatLeavesItsPartOfADensityIsToldOfHoweverFewAndFineItIs) {
  Image image{.width = 17, .height = 13, .rgba = {}};
  Random random(1);
  for (int i = 0; i < 17 * 13; ++i) {
    const auto grey = static_cast<std::uint8_t>(random.below(256));
    image.rgba.insert(image.rgba.end(), {grey, grey, grey, 255});
  }
  ASSERT_TRUE(write_image(file("d.png"), image));
  page_["terrain"] = Json::parse(R"({"size": [100, 100]})");
  page_["types"][0] =
      Json::parse(R"({"name": "oak", "tree": "a.stree", "count": 300, "spacing": 2.3, "density": "d.png"})");
  page_["types"][1]["count"] = 0;
  const std::string fine = run({"--report", file("r.json")}).err;
  EXPECT_NE(fine.find("(oak): where its density is highest the ground is full: "), std::string::npos) << fine;
  page_["types"][0]["spacing"] = 0.3;
  EXPECT_EQ(run().err, "");
  page_["types"][0]["spacing"] = 0.8;
  EXPECT_EQ(run().err, "");
  page_["types"][0]["avoid"] = {"b"};
  page_["types"][1]["count"] = 8000;
  page_["types"][1]["density"] = "d.png";
  const std::string feet = run().err;
  EXPECT_NE(
      feet.find(
          "types[0] (oak): where its density is highest the feet that it is to avoid leave no more room"),
      std::string::npos)
      << feet;
  // No map, and no more than chance.
  page_["types"][0].erase("density");
  page_["types"][1].erase("density");
  page_["types"][1]["count"] = 1000;
  page_["types"][0]["distance"] = {{"map", "d.png"}, {"max", 3}};
  EXPECT_EQ(run().err, "");
}

// A dozen trees are never where a map asks for a tenth of a tree: that is chance, and no fault of the ground.
TEST_F(Ecogen, FewTreesOnMuchGroundAreNotSaidToFillIt) {
  Image image{.width = 16, .height = 1, .rgba = {}};
  for (int i = 0; i < 64; ++i) image.rgba.push_back(static_cast<std::uint8_t>(i % 4 == 3 ? 255 : 4 * i));
  ASSERT_TRUE(write_image(file("d.png"), image));
  page_["types"].erase(1);
  page_["types"][0].merge_patch(Json::parse(R"({"scale": 1, "density": "d.png", "spacing": 0.5})"));
  for (const int count : {1, 12, 100}) {
    page_["types"][0]["count"] = count;
    const Outcome o = run();
    ASSERT_EQ(o.status, 0);
    EXPECT_EQ(o.err.find("the ground is full"), std::string::npos) << o.err;
  }
}

TEST_F(Ecogen, AScaleMapNeedsARangeOfScales) {
  page_["types"][1]["scale_map"] = "s.png";
  EXPECT_NE(refusal().find("types[1].scale_map: scale has no range"), std::string::npos);
}

TEST_F(Ecogen, DiscsByHandThatOverlapAreWarnedOf) {
  page_["types"][0]["spacing"] = 1;
  page_["types"][0]["count"] = 1;
  page_["types"][0]["instances"] = Json::parse(R"([{"x": 5, "z": 5}, {"x": 6, "z": 5}, {"x": 20, "z": 5}])");
  const Outcome o = run();
  EXPECT_EQ(o.status, 0);
  EXPECT_NE(o.err.find("types[0] (a): 1 by hand overlap others by hand"), std::string::npos) << o.err;
}

TEST_F(Ecogen, SpacedTypesKeepOffTheFeetThatTheyAreToAvoid) {
  page_["types"] = Json::parse(
      R"([{"name": "a", "tree": "a.stree", "count": 300, "scale": 0.01, "footprint": 0},
          {"name": "b", "tree": "b.tree", "count": 60, "scale": {"min": 0.5, "max": 1.5}, "spacing": 1, "avoid": ["a"]}])");
  const auto nearest = [&] {
    const Ecosystem eco = load();
    std::vector<Instance> all;
    for (const InstanceBlock& b : eco.blocks)
      for (std::size_t i = b.first; i < b.first + b.count; ++i) all.push_back(instance_of(eco, b, i));
    double least = 1e9;
    for (const Instance& b : all)
      for (const Instance& a : all)
        if (b.type == 1 && a.type == 0)
          least =
              std::min(least, std::hypot(a.position.x - b.position.x, a.position.z - b.position.z) / b.scale);
    return least;
  };
  ASSERT_EQ(run().status, 0);
  EXPECT_GE(nearest(), 1 - 1e-4);
  page_["types"][1].erase("avoid");
  ASSERT_EQ(run().status, 0);
  EXPECT_LT(nearest(), 0.9);  // nobody asked for it
  page_["types"][1]["avoid"] = {"aa"};
  std::filesystem::remove(file("out.eco"));
  EXPECT_NE(refusal().find("types[1].avoid[0]: there is no type called 'aa'"), std::string::npos);
  page_["types"][1]["avoid"] = {"a"};
  page_["types"][1].erase("spacing");
  EXPECT_NE(refusal().find("types[1].avoid: 'b' has no spacing"), std::string::npos);
}

// Of a slope of 45 degrees towards +x.
TEST_F(Ecogen, ByHandWhatIsSaidOfPitchAndRollIsKept) {
  page_["terrain"] =
      Json::parse(R"({"size": [20, 20], "nurbs": {"degree": [1, 1], "heights": [[0, 20], [0, 20]]}})");
  page_["materials"] = Json::array();
  page_["types"].erase(1);
  page_["types"][0].erase("count");
  page_["types"][0]["instances"] = Json::parse(
      R"([{"x": 2, "z": 5}, {"x": 4, "z": 5, "head": 30}, {"x": 6, "z": 5, "pitch": 0}, {"x": 8, "z": 5, "roll": 0.001}])");
  write_text(file("more.csv"), "type, x ,z,pitch,roll\n a,+10,5,,\na, 12,5,0,0\n\"a\",14,5 ,,0\n");
  const Outcome o = run({"--instances", file("more.csv")});
  ASSERT_EQ(o.status, 0) << o.err;
  const Ecosystem eco = load();
  std::map<int, double> up;
  for (const InstanceBlock& b : eco.blocks)
    for (std::size_t i = b.first; i < b.first + b.count; ++i) {
      const Instance instance = instance_of(eco, b, i);
      up[static_cast<int>(std::lround(instance.position.x))] = rotate(instance.rotation, {0, 1, 0}).y;
    }
  ASSERT_EQ(up.size(), 7u);
  for (const int along : {2, 4, 10}) EXPECT_NEAR(up[along], std::sqrt(0.5), 1e-5) << along;
  for (const int upright : {6, 8, 12, 14}) EXPECT_NEAR(up[upright], 1, 1e-5) << upright;
}

TEST_F(Ecogen, TreesLargerThanTheirCellsAreWarnedOfAndShowNoGrid) {
  page_["types"][0]["count"] = 600, page_["types"][0]["scale"] = 1, page_["types"][0]["footprint"] = 30;
  page_["types"].erase(1);
  const Outcome o = run();
  ASSERT_EQ(o.status, 0);
  EXPECT_NE(o.err.find("types[0] (a): 600 of 600 are larger than their cell"), std::string::npos) << o.err;
  const Ecosystem eco = load();
  std::set<double> columns;
  for (const InstanceBlock& b : eco.blocks)
    for (std::size_t i = b.first; i < b.first + b.count; ++i)
      columns.insert(std::round(1000 * instance_of(eco, b, i).position.x));
  EXPECT_GT(columns.size(), 500u);  // 25 when all stand in the middle
}

TEST_F(Ecogen, OneThatFloatsByHandDoesNotLiftTheOthers) {
  page_["types"][0]["instances"] = Json::parse(R"([{"x": 5, "y": 77, "z": 5}])");
  ASSERT_EQ(run({"--report", file("r.json")}).status, 0);
  const Json report = Json::parse(read_text(file("r.json")));
  for (const auto& error : report["errors"])
    if (error["name"] == "foot off the ground") {
      EXPECT_LE(error["max"].get<double>(), 1e-5);
    }
  const Ecosystem eco = load();
  int floating = 0;
  for (const InstanceBlock& b : eco.blocks)
    for (std::size_t i = b.first; i < b.first + b.count; ++i)
      floating += std::abs(instance_of(eco, b, i).position.y - 77) < 1e-3;
  EXPECT_EQ(floating, 1);
}

}  // namespace
}  // namespace copse
