#include "lib/analysis/lod/limb_chains.h"
#include "lib/formats/container/atomic_file.h"
#include "lib/formats/import/import.h"
#include "lib/formats/tree_file/tree_file.h"
#include "lib/formats/tree_file/tree_volumes.h"
#include "tests/formats/tampering.h"
#include "tests/formats/tree_maker.h"
#include "tests/tools/process.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace copse {
namespace {

using nlohmann::json;

constexpr const char* k_cube =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n"
    "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

class Bvfit : public testing::Test {
 protected:
  static Outcome run(std::vector<std::string> arguments, const char* tool = "bvfit") {
    arguments.insert(arguments.begin(), tool);
    return run_process(arguments);
  }
  std::string cube() const { return save("cube.obj", k_cube); }
  std::string save(const std::string& name, const std::string& text) const {
    write_text(folder_.path() / name, text);
    return folder_.file(name);
  }
  std::string tree(std::uint64_t seed = 1) const {
    const auto bytes = encode_tree(
        make_tree({.radii = 30, .leaves = 40, .groups = 9, .ring = 5, .segment = 10, .leaf = 2}, seed));
    EXPECT_TRUE(bytes);
    EXPECT_TRUE(write_file(folder_.path() / "oak.stree", std::span<const std::uint8_t>(*bytes)));
    return folder_.file("oak.stree");
  }
  json fitted(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"-o", folder_.file("out.json"), "-q"});
    const Outcome o = run(arguments);
    EXPECT_EQ(o.status, 0) << o.err;
    return json::parse(read_text(folder_.path() / "out.json"));
  }
  static const json& of(const json& set, const std::string& type, const std::string& method) {
    for (const json& v : set["volumes"]) {
      if (v["type"] == type && v["method"] == method) return v;
    }
    ADD_FAILURE() << type << " " << method << " is missing";
    return set["volumes"][0];
  }
  TemporaryFolder folder_;
};

TEST_F(Bvfit, ACubeHasTheVolumesThatItMustHave) {
  const json j = fitted({cube(), "--methods", "all"});
  EXPECT_EQ(j["schema"], "copse.volumes/1");
  EXPECT_EQ(j["points"], 8);
  EXPECT_EQ(j["hull_points"], 8);
  const json& set = j["sets"][0];
  EXPECT_EQ(set["name"], "whole");
  EXPECT_EQ(set["criterion"], "volume");
  EXPECT_NEAR(of(set, "aabb", "exact")["volume"].get<double>(), 1, 1e-12);
  EXPECT_NEAR(of(set, "obb", "minimal")["volume"].get<double>(), 1, 1e-6);
  EXPECT_NEAR(of(set, "sphere", "minimal")["volume"].get<double>(), 2.720699046, 1e-6);
  EXPECT_LE(of(set, "capsule", "minimal")["volume"].get<double>(), 2.63945038 * 1.01);
  EXPECT_LE(of(set, "lozenge", "minimal")["volume"].get<double>(), 2.444035895 * 1.01);
  EXPECT_EQ(set["volumes"][set["chosen"].get<std::size_t>()]["type"],
            "aabb");  // as small as the box, and cheaper
  for (const json& v : set["volumes"]) {
    EXPECT_TRUE(v["certified"].get<bool>());
    if (v["lower_bound"].is_number()) {
      EXPECT_LE(v["lower_bound"].get<double>(), v["volume"].get<double>());
    }
    EXPECT_FALSE(v.contains("seconds"));
  }
}

TEST_F(Bvfit, TheMinimalSphereNamesThePointsThatHoldIt) {
  const json j = fitted({save("four.xyz", "0 0 0\n2 0 0\n1 0.5 0\n1 -0.5 0.25\n0 0 0\n")});
  EXPECT_EQ(of(j["sets"][0], "sphere", "minimal")["support"], json::parse("[[0.0,0.0,0.0],[2.0,0.0,0.0]]"));
  const Outcome o = run({cube()});
  EXPECT_NE(o.out.find("the minimal sphere is held by (0, "), std::string::npos) << o.out;
}

TEST_F(Bvfit, ExactSaysWhatItCouldNotProve) {
  const Outcome proven = run({cube(), "--quality", "exact"});
  EXPECT_EQ(proven.err.find("not proven"), std::string::npos) << proven.err;
  const Outcome o = run({cube(), "--quality", "exact", "--budget", "1e-6", "--volumes", "lozenge"});
  EXPECT_EQ(o.status, 0);
  EXPECT_NE(o.err.find("lozenge (minimal) of 'whole'"), std::string::npos) << o.err;
  EXPECT_NE(o.err.find("not proven"), std::string::npos) << o.err;
}

TEST_F(Bvfit, ATinyBudgetStillGivesACertifiedVolumeOfEachTypeAndTimeEnoughTheLeast) {
  const json quick = fitted({cube(), "--budget", "1e-9"}), whole = fitted({cube()}),
             timed = fitted({cube(), "--budget", "30"});
  ASSERT_EQ(quick["sets"][0]["volumes"].size(), whole["sets"][0]["volumes"].size());
  for (std::size_t i = 0; i < whole["sets"][0]["volumes"].size(); ++i) {
    const json &q = quick["sets"][0]["volumes"][i], &w = whole["sets"][0]["volumes"][i],
               &t = timed["sets"][0]["volumes"][i];
    EXPECT_EQ(q["type"], w["type"]);
    EXPECT_TRUE(q["certified"].get<bool>()) << q.dump();
    EXPECT_GE(q["volume"].get<double>(), w["volume"].get<double>() * (1 - 1e-6)) << q.dump();
    EXPECT_LE(t["volume"].get<double>(), w["volume"].get<double>() * (1 + 1e-6)) << t.dump();
  }
}

TEST_F(Bvfit, NumbersAreFloat32AndReadTheSameAsDoubles) {
  const json j = fitted({cube()});
  std::size_t seen = 0;
  const auto look = [&](const auto& self, const json& value) -> void {
    if (value.is_array()) {
      for (const json& x : value) self(self, x);
    } else {
      const double x = value.get<double>();
      EXPECT_EQ(static_cast<double>(static_cast<float>(x)), x);
      ++seen;
    }
  };
  for (const json& v : j["sets"][0]["volumes"]) {
    for (const char* member : {"min", "max", "center", "radius", "axes", "half_extents", "a", "b", "origin",
                               "edge0", "edge1", "semi_axes", "normals"}) {
      if (v.contains(member)) look(look, v[member]);
    }
  }
  EXPECT_GT(seen, 30u);
}

TEST_F(Bvfit, TheFileIsTheSameForAnyNumberOfThreadsAndOnlyTimesChangeIt) {
  const std::string oak = tree();
  for (const char* jobs : {"1", "4"}) {
    ASSERT_EQ(run({oak, "--per", "groups", "-j", jobs, "-q", "-o", folder_.file(std::string(jobs) + ".json")})
                  .status,
              0);
  }
  EXPECT_EQ(read_text(folder_.path() / "1.json"), read_text(folder_.path() / "4.json"));
  const json j = fitted({cube(), "--times"});
  for (const json& v : j["sets"][0]["volumes"]) EXPECT_TRUE(v["seconds"].is_number());
}

TEST_F(Bvfit, TheTableTellsAPersonWhatWasChosen) {
  const Outcome o = run({cube()});
  EXPECT_EQ(o.status, 0) << o.err;
  for (const char* part :
       {"whole: 8 points, 8 on the hull", "type", "method", "certified", "> aabb", "sphere     minimal"}) {
    EXPECT_NE(o.out.find(part), std::string::npos) << part << "\n" << o.out;
  }
  EXPECT_EQ(run({cube(), "-q"}).out, "");
}

TEST_F(Bvfit, JsonGoesToStdoutAlone) {
  const Outcome o = run({cube(), "-o", "-"});
  EXPECT_EQ(json::parse(o.out)["schema"], "copse.volumes/1");
}

TEST_F(Bvfit, EveryPartOfATreeIsFittedStoredAndVerified) {
  const std::string oak = tree(), out = folder_.file("oak.bv.stree");
  const Outcome o =
      run({oak, "--per", "groups,segments", "--hierarchy", "kd4", "--quality", "fast", "-o", out});
  ASSERT_EQ(o.status, 0) << o.err;
  const auto file = TreeFile::open(out);
  ASSERT_TRUE(file);
  EXPECT_TRUE(file->verify().empty()) << file->verify().front();
  const auto v = load_volumes(*file);
  ASSERT_TRUE(v) << v.error().what;
  std::array<std::size_t, k_volume_parts> parts{};
  for (const VolumeSet& s : v->sets) ++parts[static_cast<std::size_t>(s.part)];
  EXPECT_EQ(parts[0], 1u);
  EXPECT_EQ(parts[1], 1u);
  EXPECT_EQ(parts[2], 1u);
  EXPECT_EQ(parts[3], 9u);
  EXPECT_GT(parts[4], 20u);
  EXPECT_GT(parts[6], 3u);
  ASSERT_FALSE(v->nodes.empty());
  EXPECT_EQ(v->sets[v->nodes[0].set].part, VolumePart::node);
  for (const VolumeRecord& r : v->volumes) EXPECT_EQ(r.flags, VolumeRecord::certified);
  EXPECT_TRUE(same(*file->load(), *TreeFile::open(oak)->load()));
  const Outcome verified = run({"--verify", out, oak});
  EXPECT_EQ(verified.status, 0) << verified.err;
  EXPECT_NE(verified.out.find("group 3"), std::string::npos);
  EXPECT_EQ(run({out, "--verify"}, "treedump").status, 0);
  const Outcome summary = run({out}, "treedump");
  EXPECT_NE(summary.out.find("bounding volumes"), std::string::npos);
  EXPECT_NE(summary.out.find(" of them certified, chosen: "), std::string::npos) << summary.out;
  const Outcome dumped = run({out, "--json", "--arrays"}, "treedump");
  EXPECT_EQ(dumped.status, 0) << dumped.err;
  const json volumes = json::parse(dumped.out)["volumes"];
  ASSERT_EQ(volumes.size(), v->sets.size());
  EXPECT_EQ(volumes[0]["name"], "whole");
  EXPECT_EQ(volumes[0]["volumes"][0]["numbers"][0].get<float>(), v->numbers[0]);
}

TEST_F(Bvfit, TreedumpFindsAVolumeThatIsNotWhatItSays) {
  const std::string out = folder_.file("oak.bv.stree");
  ASSERT_EQ(run({tree(), "--per", "groups", "--volumes", "sphere", "-q", "-o", out}).status, 0);
  const std::string text = read_text(out);
  std::vector<std::uint8_t> bytes(text.begin(), text.end());
  const std::size_t radius = tampering::section_at(bytes, "VNUM") + 4 * (4 * 5 + 3);  // of the third group
  tampering::set(bytes, radius, get<float>(bytes, radius) * 0.99f);
  ASSERT_TRUE(write_file(out, std::span<const std::uint8_t>(bytes)));
  const Outcome o = run({out, "--verify"}, "treedump");
  EXPECT_EQ(o.status, 1);
  EXPECT_NE(o.out.find("VOLU[5]: sphere (minimal) of group 2 leaves"), std::string::npos) << o.out;
}

TEST_F(Bvfit, VerifyNamesTheWorstPointOfAVolumeThatIsTooSmall) {
  const std::string mesh = cube();
  json j = fitted({mesh});
  for (json& v : j["sets"][0]["volumes"]) {
    if (v["type"] == "sphere") v["radius"] = v["radius"].get<double>() * 0.9;
    if (v["type"] == "aabb") v["max"][0] = std::nextafter(1.0, 0.0);
  }
  const std::string file = save("small.json", j.dump());
  const Outcome o = run({"--verify", file, mesh});
  EXPECT_EQ(o.status, 1);
  EXPECT_EQ(line_count(o.err), 1u);
  EXPECT_NE(o.err.find("2 of "), std::string::npos) << o.err;
  EXPECT_NE(o.err.find("the worst is sphere (minimal) of 'whole': point 0 (0, 0, 0)"), std::string::npos)
      << o.err;
  EXPECT_NE(o.out.find("leaves 8 of 8 points outside"), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("leaves 4 of 8 points outside"), std::string::npos) << o.out;
}

TEST_F(Bvfit, VerifyJudgesWhatOthersWrote) {
  const std::string mesh = cube();
  const std::string good = save("good.json", R"({"sets":[{"volumes":[
    {"type":"sphere","center":[0.5,0.5,0.5],"radius":0.8660254037844388},
    {"type":"lozenge","origin":[0,0,0.5],"edge0":[1,0,0],"edge1":[0,1,0],"radius":0.5},
    {"type":"kdop","normals":[[1,0,0],[0,2,0],[0,0,1]],"min":[0,0,0],"max":[1,2,1]}]}]})");
  EXPECT_EQ(run({"--verify", good, mesh}).status, 0) << run({"--verify", good, mesh}).err;
  // a radius rounded down, as all libraries leave it
  const std::string nearly = save(
      "nearly.json",
      R"({"sets":[{"volumes":[{"type":"sphere","center":[0.5,0.5,0.5],"radius":0.8660254037844386}]}]})");
  EXPECT_EQ(run({"--verify", nearly, mesh}).status, 1);
  const std::pair<const char*, const char*> wrong[] = {
      {"[1,2", "line 1 column 5"},
      {"[1,2]", "no JSON"},
      {R"({"sets":[],"sets":[]})", "the key 'sets' stands twice"},
      {R"({"sets":[{"name":7,"volumes":[]}]})", "its \"name\" is no text"},
      {"{}", "no \"sets\""},
      {R"({"sets":[{"volumes":[{"type":"ball"}]}]})", "type 'ball' is unknown"},
      {R"({"sets":[{"volumes":[{"type":"sphere","center":[1,2],"radius":1}]}]})", "'center' of this sphere"},
      {R"({"sets":[{"name":"group 1","volumes":[]}]})", "a mesh has no leaf groups"},
      {R"({"sets":[{"name":"crown","volumes":[]}]})", "no set of points 'crown'"},
      {R"({"sets":[{"volumes":[{"type":"sphere","center":[0,0,0],"radius":-9}]}]})", "leave points outside"},
      {R"({"sets":[]})", "nothing to verify"},
      {R"({"sets":[{"volumes":[{"type":"obb","center":[0,0,0],"axes":[[2,0,0],[0,1,0],[0,0,1]],"half_extents":[9,9,9]}]}]})",
       "leave points outside"},
      {R"({"sets":[{"volumes":[{"type":"ellipsoid","center":[0,0,0],"axes":[[1,0,0],[0.01,1,0],[0,0,1]],"semi_axes":[9,9,9]}]}]})",
       "leave points outside"},
      {R"({"sets":[{"volumes":[{"type":"sphere","center":[0,0,0],"radius":2,"volume":33.6}]}]})",
       "of 'whole': its \"volume\" is 33.5103"},
      {R"({"sets":[{"volumes":[{"type":"sphere","center":[0,0,0],"radius":2,"lower_bound":33.6}]}]})",
       "is no bound of its volume"},
      {R"({"sets":[{"volumes":[{"type":"sphere","center":[0,0,0],"radius":1e999}]}]})",
       "1e999 is more than a number can be"}};
  for (const auto& [text, says] : wrong) {
    const Outcome o = run({"--verify", save("wrong.json", text), mesh});
    EXPECT_EQ(o.status, 1) << text;
    EXPECT_EQ(line_count(o.err), 1u) << o.err;
    EXPECT_NE(o.err.find(says), std::string::npos) << o.err;
  }
  const std::string deep = save("deep.json", std::string(100000, '['));
  EXPECT_EQ(run({"--verify", deep, mesh}).status, 1);
}

TEST_F(Bvfit, PointFilesAreReadInDoubleAndFlatOnesHaveNoVolume) {
  const json line = fitted({save("line.xyz", "0.1 0.2 0.3\n0.2 0.4 0.6\n0.3 0.6 0.9\n")});
  EXPECT_EQ(line["points"], 3);
  for (const json& v : line["sets"][0]["volumes"]) EXPECT_TRUE(v["certified"].get<bool>()) << v.dump();
  const json one = fitted({save("one.xyz", "1 2 3\n")});
  EXPECT_EQ(of(one["sets"][0], "sphere", "minimal")["radius"].get<double>(), 0);
  EXPECT_EQ(of(one["sets"][0], "obb", "minimal")["half_extents"], json({0.0, 0.0, 0.0}));
  const json grid = fitted({save("grid.xyz", "0 0 0\n1 0 0\n0 2 0\n1 2 0\n")});
  EXPECT_EQ(of(grid["sets"][0], "obb", "minimal")["volume"].get<double>(), 0);
  EXPECT_EQ(of(grid["sets"][0], "lozenge", "minimal")["volume"].get<double>(), 0);
}

TEST_F(Bvfit, ChoicesFollowTheirCriterion) {
  const std::string mesh = cube();
  const auto type = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), mesh);
    const json set = fitted(arguments)["sets"][0];
    return set["volumes"][set["chosen"].get<std::size_t>()]["type"].get<std::string>();
  };
  EXPECT_EQ(type({"--choose", "volume"}), "aabb");
  EXPECT_EQ(type({"--choose", "weighted", "--volumes", "sphere,lozenge"}), "sphere");
  EXPECT_EQ(type({"--choose", "volume", "--volumes", "sphere,lozenge"}), "lozenge");
  EXPECT_EQ(type({"--choose", "expected", "--content-cost", "0"}), "sphere");
  EXPECT_EQ(type({"--choose", "aspect"}), "lozenge");
  EXPECT_EQ(type({"--choose", "aspect", "--aspect-tree", "seed"}), "sphere");
  EXPECT_EQ(type({"--choose", "aspect", "--aspect-tree", "capsule"}), "capsule");
  // only what the tree picks is fitted
  EXPECT_EQ(fitted({mesh, "--choose", "aspect", "--aspect-tree", "capsule"})["sets"][0]["volumes"].size(),
            1u);
  EXPECT_NE(run({mesh, "--choose", "expected", "--costs", "measured"}).status, 70);
}

TEST_F(Bvfit, TheDrawnVolumesAreAMeshRoundTheMesh) {
  const std::string glb = folder_.file("cube.glb");
  ASSERT_EQ(run({cube(), "--export-glb", glb, "-q"}).status, 0);
  const auto import = import_mesh(glb);
  ASSERT_TRUE(import) << import.error().what;
  EXPECT_GT(import->mesh.parts.size(), 4u);
  const DoubleBox box = bounds(import->mesh);
  EXPECT_LT(box.min.x, 0);
  EXPECT_GT(box.max.y, 1);
}

TEST_F(Bvfit, ThePageShowsPicturesAndTheSweepItsCurves) {
  const std::string page = folder_.file("cube.html"), report = folder_.file("cube.report.json");
  const Outcome o = run({cube(), "--sweep", "--html", page, "--report", report});
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_NE(o.out.find("error against time"), std::string::npos);
  const std::string html = read_text(page);
  EXPECT_NE(html.find("Volumes round whole, from the side"), std::string::npos);
  EXPECT_NE(html.find("volume / proven bound - 1"), std::string::npos);
  const json j = json::parse(read_text(report));
  EXPECT_GT(j["curves"].size(), 3u);
  EXPECT_GT(j["curves"][2]["points"].size(), 2u);
}

TEST_F(Bvfit, HierarchiesAreComparedWithTheDissertation) {
  const Outcome o = run({tree(), "--per", "groups", "--quality", "fast", "--compare-hierarchies", "--tune"});
  ASSERT_EQ(o.status, 0) << o.err;
  for (const char* part :
       {"kd16", "rtree8", "clusters", "original", "flat", "19 h 26 min", "aspect trees on", "    seed  "}) {
    EXPECT_NE(o.out.find(part), std::string::npos) << part;
  }
}

TEST_F(Bvfit, SwayingPartsHaveASecondVolumeRoundTheirMotion) {
  const json j = fitted({tree(), "--per", "groups", "--sway", "10", "--quality", "fast"});
  double rest = 0, envelope = 0;
  for (const json& set : j["sets"]) {
    if (set["name"] == "whole") rest = of(set, "sphere", "minimal")["volume"];
    if (set["name"] == "whole envelope") envelope = of(set, "sphere", "minimal")["volume"];
  }
  EXPECT_GT(rest, 0);
  EXPECT_GT(envelope, rest * 1.05);
}

TEST_F(Bvfit, EverythingInAFileIsJudgedNodesAndEnvelopesToo) {
  const std::string oak = tree(), json_file = folder_.file("oak.json"), out = folder_.file("oak.bv.stree");
  const std::vector<std::string> call{oak,      "--per", "groups,segments", "--hierarchy", "rtree4",
                                      "--sway", "7.1",   "--quality",       "fast",        "-q"};
  for (const std::string& file : {json_file, out}) {
    std::vector<std::string> with_output = call;
    with_output.insert(with_output.end(), {"-o", file});
    ASSERT_EQ(run(with_output).status, 0);
    const Outcome o = run({"--verify", file, oak});
    EXPECT_EQ(o.status, 0) << o.err;
    for (const char* set : {"group 3 envelope ", "node 0 envelope ", "segment 2 "})
      EXPECT_NE(o.out.find(set), std::string::npos) << set;
    EXPECT_EQ(o.out.find("outside"), std::string::npos);
  }
  EXPECT_EQ(run({out, "--verify"}, "treedump").status, 0);
  const json j = json::parse(read_text(json_file));
  std::size_t found = 0;
  for (std::size_t s = 0; s < j["sets"].size(); ++s) {
    const std::string name = j["sets"][s]["name"];
    if (name != "group 3 envelope" && name != "node 0 envelope") continue;
    json small = j;
    for (json& v : small["sets"][s]["volumes"]) {
      if (v["type"] == "sphere") v["radius"] = v["radius"].get<double>() * 0.999;
    }
    const Outcome o = run({"--verify", save("small.json", small.dump()), oak});
    EXPECT_EQ(o.status, 1);
    EXPECT_NE(o.err.find("1 of "), std::string::npos) << o.err;
    EXPECT_NE(o.err.find("of '" + name + "'"), std::string::npos) << o.err;
    ++found;
  }
  EXPECT_EQ(found, 2u);
  for (const char* nodes :
       {R"([{"skip":9,"set":0}])", R"([{"skip":1,"set":99999}])", R"([{"skip":0,"set":0}])",
        R"([{"skip":3,"set":0},{"skip":3,"set":0},{"skip":3,"set":1}])", "[7]"}) {
    json wrong = j;
    wrong["nodes"] = json::parse(nodes);
    const Outcome o = run({"--verify", save("wrong.json", wrong.dump()), oak});
    EXPECT_EQ(o.status, 1);
    EXPECT_NE(o.err.find("no hierarchy"), std::string::npos) << o.err;
  }
}

TEST_F(Bvfit, FoliageCellsAreFittedStoredAndVerified) {
  const std::string oak = tree(), celled = folder_.file("cells.stree"), out = folder_.file("cells.bv.stree");
  ASSERT_EQ(
      run({oak, "--foliage", "prune", "--cells", "6", "--views", "12", "-q", "-o", celled}, "lodbake").status,
      0);
  const Outcome o =
      run({celled, "--per", "cells", "--hierarchy", "kd2", "--quality", "fast", "-q", "-o", out});
  ASSERT_EQ(o.status, 0) << o.err;
  const auto v = load_volumes(*TreeFile::open(out));
  ASSERT_TRUE(v) << v.error().what;
  EXPECT_EQ(std::count_if(v->sets.begin(), v->sets.end(),
                          [](const VolumeSet& s) { return s.part == VolumePart::cell; }),
            6);
  EXPECT_EQ(run({"--verify", out, celled}).status, 0);
  EXPECT_EQ(run({out, "--verify"}, "treedump").status, 0);
  const Outcome without = run({"--verify", out, oak});
  EXPECT_EQ(without.status, 1);
  EXPECT_NE(without.err.find("no foliage cells"), std::string::npos) << without.err;
}

TEST_F(Bvfit, AScenesObjectsAreItsParts) {
  const std::string mesh =
      save("scene.obj", std::string("o first\n") + k_cube +
                            "o second\nv 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\nf 9 10 11\nf 9 10 12\n");
  const json j = fitted({mesh, cube(), "--per", "whole,parts"});
  ASSERT_EQ(j["sets"].size(), 4u);
  EXPECT_EQ(j["sets"][1]["name"], "part 0 first");
  EXPECT_EQ(j["sets"][2]["points"], 4);
}

// Each node of the hierarchy as the names of the parts below it.
std::vector<std::string> nodes_of(const json& j) {
  std::vector<std::string> out;
  const json& nodes = j["nodes"];
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    std::string below;
    for (std::size_t k = i; k < nodes[i]["skip"]; ++k) {
      if (nodes[k]["skip"] == k + 1)
        below += j["sets"][nodes[k]["set"].get<std::size_t>()]["name"].get<std::string>() + ", ";
    }
    out.push_back(below);
  }
  return out;
}

TEST_F(Bvfit, TheOriginalHierarchyIsTheOneOfTheFiles) {
  const std::string legs = "g leg\nf 1 2 3\ng seat\nf 2 3 4\n";
  const std::string mesh =
      save("scene.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\no chair\n" + legs + "o chair\n" + legs);
  const json j = fitted({mesh, cube(), "--per", "parts", "--hierarchy", "original", "--quality", "fast"});
  EXPECT_EQ(nodes_of(j), (std::vector<std::string>{
                             "part 0 leg, part 1 seat, part 2 leg, part 3 seat, part 4, ",
                             "part 0 leg, part 1 seat, part 2 leg, part 3 seat, ",
                             "part 0 leg, part 1 seat, ", "part 0 leg, ", "part 1 seat, ",
                             "part 2 leg, part 3 seat, ", "part 2 leg, ", "part 3 seat, ", "part 4, "}));
}

TEST_F(Bvfit, TheOriginalHierarchyOfATreeIsItsLimbs) {
  const std::string oak = tree();
  const json j = fitted({oak, "--per", "groups,segments", "--hierarchy", "original", "--quality", "fast"});
  const auto loaded = TreeFile::open(oak)->load();
  ASSERT_TRUE(loaded);
  const std::vector<LimbChain> limbs = limb_chains(*loaded);
  ASSERT_GT(limbs.size(), 3u);
  const std::vector<std::string> nodes = nodes_of(j);
  // What hangs on a limb: its own segments and those of all limbs that grow from it.
  std::size_t found = 0;
  for (std::size_t l = 0; l < limbs.size(); ++l) {
    std::set<std::string> segments;
    std::vector<bool> below(limbs.size());
    for (std::size_t k = l; k < limbs.size(); ++k) {
      below[k] = k == l || (limbs[k].parent != k_none && below[limbs[k].parent]);
      for (const std::uint32_t s : limbs[k].segments) {
        if (below[k]) segments.insert("segment " + std::to_string(s) + ",");
      }
    }
    found += std::any_of(nodes.begin(), nodes.end(), [&](const std::string& node) {
      std::size_t count = 0;
      for (std::size_t at = node.find("segment "); at != std::string::npos;
           at = node.find("segment ", at + 1))
        ++count;
      return count == segments.size() &&
             std::all_of(segments.begin(), segments.end(),
                         [&](const std::string& s) { return node.find(s) != std::string::npos; });
    });
  }
  EXPECT_EQ(found, limbs.size());
}

TEST_F(Bvfit, PartsAreNumberedInTheOrderOfTheFileAndAllDrawn) {
  const std::string mesh =
      save("scene.obj", std::string("o zebra\n") + k_cube +
                            "o ant\nv 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\nf 9 10 11\nf 9 10 12\n");
  const json j = fitted({mesh, "--per", "parts", "--html", folder_.file("page.html")});
  ASSERT_EQ(j["sets"].size(), 2u);
  EXPECT_EQ(j["sets"][0]["name"], "part 0 zebra");
  EXPECT_EQ(j["sets"][1]["name"], "part 1 ant");
  EXPECT_NE(read_text(folder_.path() / "page.html").find("Volumes of the parts"), std::string::npos);
}

TEST_F(Bvfit, VerifyNamesTheAxisThatIsNotUnitAndNoMethodWhereNoneIsTold) {
  const std::string box = R"({"sets":[{"volumes":[{"type":"obb","center":[0.5,0.5,0.5],)"
                          R"("axes":[[1,0,0],[0,2,0],[0,0,1]],"half_extents":[1,1,1]}]}]})";
  const Outcome axis = run({"--verify", save("axis.json", box), cube()});
  EXPECT_EQ(axis.status, 1);
  EXPECT_NE(axis.err.find("axis 1 is 2 long"), std::string::npos) << axis.err;
  EXPECT_EQ(axis.err.find("()"), std::string::npos) << axis.err;
  const std::string skew = R"({"sets":[{"volumes":[{"type":"obb","center":[0.5,0.5,0.5],)"
                           R"("axes":[[1,0,0],[0,1,0],[0.6,0,0.8]],"half_extents":[9,9,9]}]}]})";
  const Outcome angle = run({"--verify", save("skew.json", skew), cube()});
  EXPECT_EQ(angle.status, 1);
  EXPECT_NE(angle.err.find("axes 0 and 2 are at 53.13"), std::string::npos) << angle.err;
  const std::string ball = R"({"sets":[{"volumes":[{"type":"sphere","center":[0.5,0.5,0.5],)"
                           R"("radius":0.8660254037844386}]}]})";
  const Outcome hair = run({"--verify", save("hair.json", ball), cube()});
  EXPECT_EQ(hair.status, 1);
  EXPECT_EQ(hair.err.find("by 0;"), std::string::npos) << hair.err;
}

TEST_F(Bvfit, VerifyNamesEdgesThatAreNotAtRightAnglesAndSlabsThatHoldNothingIn) {
  const auto judged = [&](const std::string& volume) {
    return run({"--verify", save("v.json", R"({"sets":[{"volumes":[)" + volume + "]}]}"), cube()});
  };
  const Outcome parallel =
      judged(R"({"type":"lozenge","origin":[0,0,0],"edge0":[1,0,0],"edge1":[1,0,0],"radius":9})");
  EXPECT_EQ(parallel.status, 1);
  EXPECT_NE(parallel.err.find("edges are at 0 degrees"), std::string::npos) << parallel.err;
  const Outcome skew =
      judged(R"({"type":"lozenge","origin":[0,0,0],"edge0":[1,0,0],"edge1":[1,1,0],"radius":9})");
  EXPECT_EQ(skew.status, 1);
  EXPECT_NE(skew.err.find("edges are at 45 degrees"), std::string::npos) << skew.err;
  const Outcome right =
      judged(R"({"type":"lozenge","origin":[0,0,0],"edge0":[1,0,0],"edge1":[0,1,0],"radius":9})");
  EXPECT_EQ(right.status, 0) << right.err;
  const Outcome slab = judged(R"({"type":"kdop","normals":[[1,0,0]],"min":[-9],"max":[9]})");
  EXPECT_EQ(slab.status, 1);
  EXPECT_NE(slab.err.find("leave a direction open"), std::string::npos) << slab.err;
}

TEST_F(Bvfit, VerifyRefutesALowerBoundThatAQuickFitGoesBelow) {
  const std::string ball = R"({"type":"sphere","center":[0.5,0.5,0.5],"radius":1,"lower_bound":)",
                    box = R"({"type":"aabb","min":[-9,-9,-9],"max":[9,9,9],"lower_bound":)",
                    slabs = R"({"type":"kdop","normals":[[1,0,0],[0,1,0],[0,0,1]],"min":[-9,-9,-9],)"
                            R"("max":[9,9,9],"lower_bound":)",
                    capsule =
                        R"({"type":"capsule","a":[0.5,0.5,0],"b":[0.5,0.5,1],"radius":9,"lower_bound":)";
  const auto judged = [&](const std::string& volume) {
    return run({"--verify", save("v.json", R"({"sets":[{"volumes":[)" + volume + "}]}]}"), cube()});
  };
  // the least ball round the cube has 2.7207, the least box and slabs 1
  for (const std::string& fair : {ball + "2.72", box + "1", slabs + "1", capsule + "1"}) {
    const Outcome o = judged(fair);
    EXPECT_EQ(o.status, 0) << fair << o.err;
  }
  for (const std::string& unfair : {ball + "2.722", box + "1.001", slabs + "1.001", capsule + "1000"}) {
    const Outcome o = judged(unfair);
    EXPECT_EQ(o.status, 1) << unfair;
    EXPECT_NE(o.err.find("lower_bound"), std::string::npos) << o.err;
    EXPECT_NE(o.err.find("holds the points"), std::string::npos) << o.err;
  }
}

TEST_F(Bvfit, NamesWithLineBreaksAndControlCharactersArePrintedEscaped) {
  const std::string wild = R"(bark\u001b[2J\nsphere holds all)";
  const json scene = json::parse(R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0,"name":")" + wild +
                                 R"("}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
                                 R"("accessors":[{"componentType":5126,"count":3,"type":"VEC3"}]})");
  const std::string mesh = save("scene.gltf", scene.dump()), file = folder_.file("scene.json");
  const Outcome fit = run({mesh, "--per", "parts", "-o", file});
  ASSERT_EQ(fit.status, 0) << fit.err;
  const Outcome verify = run({"--verify", file, mesh});
  EXPECT_EQ(verify.status, 0) << verify.err;
  for (const Outcome& o : {fit, verify}) {
    EXPECT_NE(o.out.find("part 0 bark\\x1b[2J\\nsphere"), std::string::npos) << o.out;
    EXPECT_EQ(o.out.find('\x1b'), std::string::npos);
    EXPECT_EQ(o.out.find("\nsphere holds"), std::string::npos);
  }
}

TEST_F(Bvfit, ATypeThatTheAspectTreePicksButNobodyAskedForIsTold) {
  const std::vector<std::string> arguments{cube(), "--choose", "aspect", "--aspect-tree", "capsule"};
  EXPECT_EQ(run(arguments).err, "");
  std::vector<std::string> without = arguments;
  without.insert(without.end(), {"--volumes", "sphere,obb"});
  const Outcome o = run(without);
  EXPECT_EQ(o.status, 0);
  EXPECT_EQ(line_count(o.err), 1u) << o.err;
  EXPECT_NE(o.err.find("not asked for (capsule)"), std::string::npos) << o.err;
  EXPECT_NE(o.out.find("> obb"), std::string::npos) << o.out;
}

TEST_F(Bvfit, TuningTellsWhichTreesPickWhatWasNotFitted) {
  const Outcome o = run({cube(), "--tune", "--volumes", "sphere"});
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(o.out.find("inf"), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("in use   picks types that were not fitted"), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("tuned    100.0 % the smallest"), std::string::npos) << o.out;
}

TEST_F(Bvfit, OfEqualSpheresTheMinimalOneIsChosenAndSaysWhatHoldsIt) {
  for (const std::vector<std::string>& how :
       {std::vector<std::string>{"--methods", "all"}, std::vector<std::string>{"--quality", "fast"}}) {
    std::vector<std::string> arguments{cube(), "--volumes", "sphere"};
    arguments.insert(arguments.end(), how.begin(), how.end());
    const json set = fitted(arguments)["sets"][0];
    const json& chosen = set["volumes"][set["chosen"].get<std::size_t>()];
    EXPECT_EQ(chosen["method"], "minimal");
    EXPECT_TRUE(chosen.contains("support"));
  }
}

TEST_F(Bvfit, TheTableSaysFlatWhereThatChose) {
  const std::string solid =
      save("solid.xyz", "0 0 0\n0.8 0.6 0.1\n-0.6 0.8 0.3\n-0.3 -0.9 -0.2\n0.2 0.2 0\n");
  EXPECT_EQ(run({solid}).out.find("flat"), std::string::npos);
  const std::string plate = save("plate.xyz", "0 0 0\n1 2 3\n3 2 1\n4 4 4\n");
  const std::string out = run({plate, "--volumes", "obb,kdop,lozenge"}).out;
  EXPECT_NE(out.find("flat: the cheapest test"), std::string::npos) << out;
}

TEST_F(Bvfit, AKernelIsNotCalledTheHull) {
  std::string sphere;
  constexpr int k_points = 12000;  // more corners than the hull is built of
  for (int i = 0; i < k_points; ++i) {
    const double z = (i + 0.5) / k_points * 2 - 1, r = std::sqrt(1 - z * z), a = 2.399963229728653 * i;
    sphere += std::to_string(r * std::cos(a)) + " " + std::to_string(r * std::sin(a)) + " " +
              std::to_string(z) + "\n";
  }
  const std::string file = save("sphere.xyz", sphere);
  const json set = fitted({file, "--volumes", "obb", "--methods", "hull"})["sets"][0];
  EXPECT_LT(set["hull_points"].get<int>(), k_points);
  EXPECT_GT(set["hull_loss"].get<double>(), 0);
  EXPECT_LT(set["hull_loss"].get<double>(), 1e-2);
  EXPECT_NE(run({file, "--volumes", "obb", "--methods", "hull"}).out.find(", a kernel of "),
            std::string::npos);
  EXPECT_EQ(fitted({cube()})["sets"][0]["hull_loss"], 0);
  EXPECT_TRUE(fitted({cube(), "--quality", "fast"})["sets"][0]["hull_loss"].is_null());
}

TEST_F(Bvfit, MistakesAreOneLineWithTheRightStatus) {
  const std::string mesh = cube();
  const std::tuple<std::vector<std::string>, int, const char*> mistakes[] = {
      {{mesh, "--volumes", "ball"}, 2, "'ball'"},
      {{mesh, "--methods", "magic"}, 2, "'magic'"},
      {{mesh, "--methods", "514"}, 2, "'514'"},
      {{mesh, "-o", "-", "--html", "-"}, 2, "two outputs"},
      {{mesh, "--report", "-", "--html", "-"}, 2, "two outputs"},
      {{mesh, "--per", "twigs"}, 2, "'twigs'"},
      {{mesh, "--per", "groups"}, 1, "a mesh has no leaf groups"},
      {{tree(), "--per", "cells"}, 1, "lodbake --foliage prune"},
      {{mesh, "--hierarchy", "kd4"}, 2, "needs parts"},
      {{tree(), "--per", "groups", "--hierarchy", "kd5"}, 2, "'kd5'"},
      {{mesh, "--sway", "5"}, 1, "moves"},
      {{mesh, "-o", folder_.file("x.stree")}, 1, "in a tree only"},
      {{mesh, "-o", folder_.file("x.txt")}, 2, "extension"},
      {{mesh, "--choose", "aspect", "--aspect-tree", "ratio9"}, 2, "character 1"},
      {{mesh, "--aspect-tree", "seed"}, 2, "add --choose aspect or --tune"},
      {{mesh, "--export-glb", folder_.file("x.gltf")}, 2, "name it .glb"},
      {{mesh, "--sweep", "-q"}, 2, "nothing is left of --sweep"},
      {{mesh, "--sweep", "-o", "-"}, 2, "leave -o - out"},
      {{mesh, "--compare-hierarchies", "-q"}, 2, "add --report or --html"},
      {{mesh, "--tune", "-q", "--report", folder_.file("r.json")}, 2, "nothing is left of --tune"},
      {{mesh, "--sweep", "--verify", mesh}, 2, "with --verify"},
      {{folder_.file("none.obj")}, 3, "none.obj"},
      {{save("bad.xyz", "1 2 3\n1 nan 3\n")}, 1, "line 2"},
      {{save("empty.xyz", "# nothing\n")}, 1, "no point"},
      {{save("huge.xyz", "1e200 0 0\n0 1e200 0\n")}, 1, "float32"},
  };
  for (const auto& [arguments, status, says] : mistakes) {
    const Outcome o = run(arguments);
    EXPECT_EQ(o.status, status) << says << ": " << o.err;
    EXPECT_EQ(line_count(o.err), 1u) << o.err;
    EXPECT_NE(o.err.find(says), std::string::npos) << o.err;
    EXPECT_EQ(o.out, "");
  }
}

TEST_F(Bvfit, TypesThatFloat32CannotHoldAreNamedInOneWarning) {
  const Outcome o = run({save("large.xyz", "-2.5e38 -2.5e38 0\n2.5e38 2.5e38 1\n-2.5e38 2.5e38 -3\n")});
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(line_count(o.err), 1u) << o.err;
  EXPECT_NE(o.err.find("float32 cannot hold them: volumes of type sphere"), std::string::npos) << o.err;
}

}  // namespace
}  // namespace copse
