// bvfit: what methods are shown, what is told of flat and left-over things, what --verify finds in sizes.
#include "tests/tools/process.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace copse {
namespace {

using nlohmann::json;

class BvfitChoices : public testing::Test {
 protected:
  static Outcome run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "bvfit");
    return run_process(arguments);
  }
  std::string save(const std::string& name, const std::string& text) const {
    write_text(folder_.path() / name, text);
    return folder_.file(name);
  }
  std::string points() const {
    return save("points.xyz", "0 0 0\n3 0 0\n0 2 0\n3 2 0\n0 0 1\n3 0 1.5\n0 2 1\n3 2 1\n1 3 0.5\n");
  }
  std::vector<std::string> methods(const std::string& type, std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"-q", "-o", folder_.file("out.json")});
    const Outcome o = run(arguments);
    EXPECT_EQ(o.status, 0) << o.err;
    std::vector<std::string> out;
    const json written = json::parse(read_text(folder_.path() / "out.json"));
    for (const json& v : written["sets"][0]["volumes"]) {
      if (v["type"] == type) out.push_back(v["method"]);
    }
    return out;
  }
  TemporaryFolder folder_;
};

TEST_F(BvfitChoices, BestIsOneOfEachTypeBesideWhatIsNamed) {
  const auto of = [&](const std::string& type, const std::string& names) {
    return methods(type, {points(), "--quality", "fast", "--methods", names});
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(of("obb", "best,14").size(), 1u);
  EXPECT_EQ(of("sphere", "best,14"), Names{"minimal"});
  EXPECT_EQ(of("kdop", "best,14"), (Names{"14", "26"}));
  EXPECT_EQ(of("sphere", "best,ritter"), (Names{"ritter", "minimal"}));
  EXPECT_EQ(of("sphere", "best,all").size(), 4u);
}

// A leaf, a card, a plate: no thickness, so that excesses are 0 / 0.
TEST_F(BvfitChoices, ASweepOfWhatIsFlatHasNumbersOnly) {
  for (const char* text : {"0 0 0\n2 0 0\n2 1 0\n0 1 0\n", "1 2 3\n", "0 0 0\n0.1 0.2 0.3\n"}) {
    const std::string page = folder_.file("p.html"), report = folder_.file("p.json");
    const Outcome o = run({save("flat.xyz", text), "--sweep", "--html", page, "--report", report});
    EXPECT_EQ(o.status, 0) << o.err;
    for (const std::string& told : {o.out, read_text(report)}) {
      EXPECT_EQ(told.find("nan"), std::string::npos) << told;
      EXPECT_EQ(told.find("inf"), std::string::npos) << told;
      EXPECT_EQ(told.find("e+15"), std::string::npos) << told;
    }
    EXPECT_EQ(read_text(page).find(">nan"), std::string::npos);
    const json curves = json::parse(read_text(report))["curves"];
    for (const json& curve : curves) {
      EXPECT_FALSE(curve["points"].empty());
      for (const json& p : curve["points"]) EXPECT_TRUE(p["y"].is_number()) << p.dump();
    }
  }
}

TEST_F(BvfitChoices, TuningWithTheAspectTreeJudgesItAgainstAllTypes) {
  const std::string file = points();
  const Outcome plain = run({file, "--tune"}), with = run({file, "--tune", "--choose", "aspect"});
  EXPECT_EQ(with.status, 0) << with.err;
  const auto tuned = [](const std::string& out) { return out.substr(out.find("aspect tree")); };
  ASSERT_NE(plain.out.find("aspect tree"), std::string::npos) << plain.out;
  ASSERT_NE(with.out.find("aspect tree"), std::string::npos) << with.out;
  EXPECT_EQ(tuned(plain.out), tuned(with.out));
}

TEST_F(BvfitChoices, VerticesInNoFaceThatReachFartherAreToldOf) {
  const std::string quad = "v 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0\n", face = "f 1 2 3 4\n";
  EXPECT_EQ(run({save("clean.obj", quad + face)}).err, "");
  EXPECT_EQ(run({save("inside.obj", quad + "v 0.5 0.5 0.1\n" + face)}).err, "");
  const Outcome o = run({save("stray.obj", quad + "v 500 0 0\n" + face)});
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_NE(o.err.find("1 of 5 vertices are in no face"), std::string::npos) << o.err;
}

TEST_F(BvfitChoices, AmongManyPartsFlatOnesAreInNoSum) {
  std::string cards;
  for (int i = 0; i < 9; ++i) {  // the last three are bent
    cards += fmt::format("o card{}\nv {} 0 0\nv {} 0 0\nv {} 1 {}\nv {} 1 0\nf -4 -3 -2 -1\n", i, 3 * i,
                         3 * i + 1, 3 * i + 1, i < 6 ? 0.0 : 0.5, 3 * i);
  }
  const Outcome o = run({save("cards.obj", cards), "--per", "parts", "--quality", "fast"});
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_NE(o.out.find("flat, in no sum"), std::string::npos) << o.out;
  EXPECT_EQ(o.out.find("-100 %"), std::string::npos) << o.out;
}

TEST_F(BvfitChoices, MinusZeroIsZero) {
  const auto fitted = [&](const char* text) {
    const Outcome o = run({save("z.xyz", text), "--volumes", "aabb,obb,sphere", "-q", "-o", "-"});
    EXPECT_EQ(o.status, 0) << o.err;
    return o.out;
  };
  EXPECT_EQ(fitted("-0.0 1 2\n0.0 3 4\n5 1 2\n5 3 7\n"), fitted("0.0 3 4\n-0.0 1 2\n5 1 2\n5 3 7\n"));
}

TEST_F(BvfitChoices, VerifyNamesASizeThatNoVolumeHas) {
  const std::string axes = R"("center":[0,0,0],"axes":[[1,0,0],[0,1,0],[0,0,1]])";
  const std::pair<std::string, const char*> wrong[] = {
      {R"({"type":"sphere","center":[0,0,0],"radius":-9})", "its radius is -9"},
      {R"({"type":"capsule","a":[0,0,0],"b":[1,0,0],"radius":-1})", "its radius is -1"},
      {R"({"type":"lozenge","origin":[0,0,0],"edge0":[1,0,0],"edge1":[0,1,0],"radius":-1})",
       "its radius is -1"},
      {R"({"type":"cylinder","a":[0,0,0],"b":[0,0,0],"radius":9})", "a and b are one point"},
      {R"({"type":"obb",)" + axes + R"(,"half_extents":[9,-9,9]})", "its half extent 1 is -9"},
      {R"({"type":"ellipsoid",)" + axes + R"(,"semi_axes":[9,9,-2]})", "its semi-axis 2 is -2"},
      {R"({"type":"aabb","min":[-9,9,-9],"max":[9,-9,9]})", "its min 9 is above its max -9 along y"},
      {R"({"type":"kdop","normals":[[1,0,0],[0,1,0],[0,0,1]],"min":[-9,-9,-9],"max":[9,9]})",
       "3 normals have 3 min and 2 max"}};
  for (const auto& [volume, says] : wrong) {
    const Outcome o =
        run({"--verify", save("v.json", R"({"sets":[{"volumes":[)" + volume + "]}]}"), points()});
    EXPECT_EQ(o.status, 1) << volume;
    EXPECT_EQ(line_count(o.err), 1u) << o.err;
    EXPECT_NE(o.err.find(says), std::string::npos) << o.err;
  }
}

}  // namespace
}  // namespace copse
