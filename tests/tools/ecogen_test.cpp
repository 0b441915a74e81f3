// ecogen as a user calls it.
#include "lib/formats/ecosystem/ecosystem_file.h"
#include "lib/formats/ecosystem/instance_codec.h"
#include "lib/formats/import/image.h"
#include "tests/tools/ecogen_folder.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace copse {
namespace {

TEST_F(Ecogen, MakesAnEcosystemThatVerifies) {
  const Outcome o = run({"--report", file("r.json"), "--depfile", file("d")});
  ASSERT_EQ(o.status, 0) << o.err;
  const Ecosystem eco = load();
  EXPECT_EQ(eco.instance_count(), 250u);
  EXPECT_EQ(eco.types[0].instances, 200u);
  EXPECT_EQ(eco.types[0].uri, "a.stree");
  EXPECT_EQ(eco.seed, 3u);
  const Json report = Json::parse(read_text(file("r.json")));
  EXPECT_EQ(report["schema"], "copse.report/1");
  for (const auto& error : report["errors"]) {
    if (error["name"] != "foot off the ground") continue;
    EXPECT_LE(error["max"].get<double>(), 1e-5);
  }
  const std::string dependencies = read_text(file("d"));
  for (const char* name : {"page.json", "a.stree", "b.tree"})
    EXPECT_NE(dependencies.find(name), std::string::npos) << name;
}

TEST_F(Ecogen, GivesTheSameBytesForAnyNumberOfThreadsAndFolder) {
  ASSERT_EQ(run({"-j", "1"}).status, 0);
  const std::string one = read_text(file("out.eco"));
  ASSERT_EQ(run({"-j", "7"}).status, 0);
  EXPECT_EQ(one, read_text(file("out.eco")));
  ASSERT_EQ(run({"--seed", "9"}).status, 0);
  EXPECT_NE(one, read_text(file("out.eco")));
}

TEST_F(Ecogen, TheTemplateFitsTheSchemaThatItPrints) {
  const Outcome page = run_process({"ecogen", "--new"}), schema = run_process({"ecogen", "--schema"});
  ASSERT_EQ(page.status, 0);
  ASSERT_EQ(schema.status, 0);
  EXPECT_EQ(Json::parse(schema.out)["$schema"], "http://json-schema.org/draft-07/schema#");
  // All that is wrong with it here is that its trees are not there.
  write_text(file("new.json"), page.out);
  const Outcome o = run_process({"ecogen", file("new.json"), "-o", file("out.eco")});
  EXPECT_EQ(o.status, 3);
  EXPECT_NE(o.err.find("oak.stree"), std::string::npos);
}

TEST_F(Ecogen, ErrorsNameThePlaceAndWhatIsAllowed) {
  struct Case {
    const char *pointer, *value, *place, *allowed;
  };
  for (const Case& c :
       {Case{"/types/1/scale", R"({"min":2,"max":1})", "types[1].scale.max: 1 is below min, 2", "swap"},
        {"/types/1/scale", "-1", "types[1].scale: -1", "a number from 1e-30"},
        {"/types/1/scale", "0", "types[1].scale: 0", "from 1e-30"},
        {"/types/0/count", "-3", "types[0].count: -3", "a whole number from 0"},
        {"/types/0/count", "1.5", "types[0].count: 1.5", "a whole number"},
        {"/types/0/scal", "1", "types[0]: 'scal' is unknown here", "did you mean 'scale'"},
        {"/terain", "1", "the document: 'terain' is unknown here", "did you mean 'terrain'"},
        {"/types/0/tilt", "\"terain\"", "types[0].tilt", "\"terrain\", \"none\""},
        {"/types/0/leaf_material", "\"godl\"", "types[0].leaf_material: there is no material called 'godl'",
         "did you mean 'gold'"},
        {"/terrain/size", "[1]", "terrain.size", "a list of 2 elements"},
        {"/terrain/samples/0", "1", "terrain.samples[0]: 1", "from 2 to 32768"},
        {"/area", "[0,0,100,10]", "area: reaches out of the terrain", "keep it within"},
        {"/area", "[5,5,5,6]", "area: holds nothing", "x0 < x1"},
        {"/types/1/name", "\"a\"", "types[1].name: 'a' is the name of types[0]", ""},
        {"/types/0/instances", R"([{"x":1}])", "types[0].instances[0]: 'z' is missing", ""},
        {"/terrain/nurbs", R"({"degree":[3,3],"heights":[[1,2],[3,4]]})", "terrain.nurbs", "too few"},
        {"/terrain/nurbs", R"({"heights":[[1,2],[3,4,5]]})", "terrain.nurbs.heights[1]: has 3 elements", ""},
        {"/terrain/nurbs", R"({"points":[[[0,0,0],[0,5,0]],[[0,0,9],[0,5,9]]],"degree":[1,1]})",
         "has no area", ""},
        {"/terrain/nurbs",
         R"({"points":[[[0,0,0],[5,0,0]],[[0,0,9],[5,0,9]]],"degree":[1,1],"weights":[[1,0],[1,1]]})",
         "terrain.nurbs.weights[0][1]: 0", "above 0"},
        {"/types/0/altitude", R"({"min":1000})", "types[0] (a): there is no place", ""},
        {"/types/0/spacing", "100", "types[0] (a): 200 asked for", "fewer"},
        {"/types/0", R"({"name":"a","tree":"a.stree","spacing":1,"avoid":["a"]})",
         "types[0].avoid[0]: 'a' has", "leave it out"},
        {"/mixes", R"([{"count":1,"parts":[{"type":"c","share":"m.png"}]}])",
         "mixes[0].parts[0].type: there is no type called 'c'", ""}}) {
    const Json before = page_;
    page_[Json::json_pointer(c.pointer)] = Json::parse(c.value);
    if (std::string(c.pointer) == "/types/0/spacing") page_["types"][0]["scale"] = 1;
    const std::string line = refusal();
    EXPECT_NE(line.find(c.place), std::string::npos) << line;
    EXPECT_NE(line.find(c.allowed), std::string::npos) << line;
    page_ = before;
  }
}

TEST_F(Ecogen, WhatIsNoJsonIsNamedByLineAndColumn) {
  write_text(file("bad.json"), "{\n \"types\": [,]\n}");
  const Outcome o = run_process({"ecogen", file("bad.json"), "-o", file("out.eco")});
  EXPECT_EQ(o.status, 1);
  EXPECT_NE(o.err.find("line 2 column 12"), std::string::npos) << o.err;
  EXPECT_EQ(line_count(o.err), 1u);
  write_text(file("bad.json"), "{\n \"seed\": -1e999}");
  const Outcome large = run_process({"ecogen", file("bad.json"), "-o", file("out.eco")});
  EXPECT_EQ(large.status, 1);
  EXPECT_NE(large.err.find("line 2 column 10: -1e999 is more than"), std::string::npos) << large.err;
  write_text(file("bad.json"), R"({"types": [], "types": []})");
  EXPECT_NE(run_process({"ecogen", file("bad.json"), "-o", file("out.eco")}).err.find("'types' stands twice"),
            std::string::npos);
  write_text(file("bad.json"), std::string(100000, '['));
  EXPECT_EQ(run_process({"ecogen", file("bad.json"), "-o", file("out.eco")}).status, 1);
}

TEST_F(Ecogen, EditsSetValues) {
  ASSERT_EQ(run({"--edit", "types[0].count=7", "--edit", "types[1].name=fern"}).status, 0);
  const Ecosystem eco = load();
  EXPECT_EQ(eco.types[0].instances, 7u);
  EXPECT_EQ(eco.types[1].name, "fern");
  for (const char* wrong : {R"(types[0]={"tree":"a.stree","count":5,"count":7})", "types[9].count=1",
                            "types[0]count", "=1", "types[x].count=1", "no.such=1", "types.[0].count=1"})
    EXPECT_EQ(run({"--edit", wrong}).status, 2) << wrong;
  page_["types"][0].erase("scale");
  const Outcome o = run({"--edit", "types[0].scale.max=0.1"});
  EXPECT_EQ(o.status, 2);
  EXPECT_NE(o.err.find(R"(--edit 'types[0].scale={"max": 0.1, ...}')"), std::string::npos) << o.err;
  EXPECT_EQ(run({"--edit", R"(types[0].scale={"max": 0.1, "min": 0.01})"}).status, 0);
  page_["block_trees"] = {"kd", "kd"};
  const Outcome twice = run();
  EXPECT_EQ(twice.status, 1);
  EXPECT_NE(twice.err.find(
                "block_trees: a list of 2 is not allowed here; give it a list of at most 2 elements, none of "
                "them twice"),
            std::string::npos)
      << twice.err;
}

TEST_F(Ecogen, ExtremesHaveADefinedResult) {
  page_["types"][0]["count"] = 0;
  page_["types"][1]["count"] = 1;
  page_["types"][1]["head"] = 1e6;
  page_["types"][1]["tilt"] = {{"pitch", 1e6}, {"roll", -1e6}};
  ASSERT_EQ(run().status, 0);
  EXPECT_EQ(load().instance_count(), 1u);
  EXPECT_EQ(load().types.size(), 1u);  // a type without instances is left out
  page_["types"] = Json::array();
  ASSERT_EQ(run().status, 0);
  EXPECT_EQ(load().instance_count(), 0u);
  page_.erase("terrain");
  page_.erase("materials");
  ASSERT_EQ(run().status, 0);
}

// A forest has fewer trees than its ground has vertices, and is no ground.
TEST_F(Ecogen, ThePageBeginsWithTheEcosystemAndItsInstances) {
  const Outcome o = run({"--export", file("q.csv"), "--html", file("out.html")});
  ASSERT_EQ(o.status, 0) << o.err;
  const std::string page = read_text(file("out.html"));
  EXPECT_NE(page.find("made out.eco and q.csv"), std::string::npos);
  EXPECT_NE(page.find("<dt>instances</dt><dd>250</dd>"), std::string::npos);
  EXPECT_EQ(page.find(" % of the input"), std::string::npos);
}

TEST_F(Ecogen, TwoExportsOfOneNameAreRefused) {
  std::filesystem::create_directory(file("d"));
  const Outcome o = run({"--export", file("q.csv"), "--export", file("d/../q.csv")});
  EXPECT_EQ(o.status, 2);
  EXPECT_NE(o.err.find("two outputs of this run have this name"), std::string::npos) << o.err;
  EXPECT_FALSE(std::filesystem::exists(file("q.csv")));
}

TEST_F(Ecogen, AFolderForAMapIsNoMesh) {
  page_["types"][0]["density"] = ".";
  const std::string line = refusal(3);
  EXPECT_NE(line.find("types[0].density: is a folder; name a file in it"), std::string::npos) << line;
}

TEST_F(Ecogen, SeedsMayBeAsLargeAsTheyAreInTheFile) {
  page_["seed"] = std::numeric_limits<std::uint64_t>::max();
  ASSERT_EQ(run().status, 0) << run().err;
  EXPECT_EQ(load().seed, std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(Json::parse(load().provenance)["options"]["seed"], std::numeric_limits<std::uint64_t>::max());
  std::filesystem::remove(file("out.eco"));
  page_["types"][0]["count"] = std::numeric_limits<std::uint64_t>::max();
  EXPECT_NE(refusal().find(
                "types[0].count: 18446744073709551615 is not allowed here; give it a whole number from 0"),
            std::string::npos);
}

TEST_F(Ecogen, AnUnreadableTextureOfAMaterialThatNothingIsMadeOfIsWarnedOf) {
  page_["materials"][1]["texture"] = "none.png";
  const Outcome o = run();
  EXPECT_EQ(o.status, 0);
  EXPECT_NE(o.err.find("none.png: materials[1].texture: "), std::string::npos) << o.err;
  EXPECT_EQ(line_count(o.err), 1u) << o.err;
  write_text(file("none.png"), "no picture");
  ASSERT_EQ(run({"--depfile", file("out.d")}).status, 0);
  EXPECT_NE(read_text(file("out.d")).find("none.png"), std::string::npos);
}

TEST_F(Ecogen, TintsGoIntoAGlbAndNowhereElse) {
  page_["types"][0]["instances"] = Json::parse(R"([{"x": 5, "z": 5, "tint": [255, 0, 188]}])");
  const Outcome o = run({"--export", file("n.glb")});
  ASSERT_EQ(o.status, 0);
  EXPECT_EQ(o.err, "");
  const std::string glb = read_text(file("n.glb"));
  EXPECT_NE(glb.find("\"_COLOR_0\""), std::string::npos);
  EXPECT_NE(run({"--export", file("n.obj")}).err.find("n.obj: tints have no place in it"), std::string::npos);
  EXPECT_NE(run({"--export", file("n.glb"), "--glb-nodes"}).err.find("n.glb: tints have no place"),
            std::string::npos);
}

// As small as a page takes, and yet a float of the file.
TEST_F(Ecogen, TinyScalesComeBackFromCsv) {
  page_["types"][0]["scale"] = 1e-30;
  ASSERT_EQ(run({"--export", file("i.csv")}).status, 0);
  page_["types"][0]["count"] = page_["types"][1]["count"] = 0;
  const Outcome o = run({"--instances", file("i.csv")});
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(load().instance_count(), 250u);
  write_text(file("i.csv"), "type,x,z,scale\na,1,1,0\n");
  EXPECT_NE(run({"--instances", file("i.csv")})
                .err.find("line 2: scale '0' is not allowed; give it a number from 1e-31"),
            std::string::npos);
}

TEST_F(Ecogen, ErrorsOfFilesNameTheirPlaceInThePage) {
  page_["types"][0]["density"] = "none.png";
  EXPECT_NE(refusal(3).find("types[0].density: "), std::string::npos);
  page_["types"][1]["tree"] = "none.stree";
  EXPECT_NE(refusal(3).find("types[1].tree: "), std::string::npos);
  write_text(file("oak.glb"), "glTF");
  page_["types"][1]["tree"] = "oak.glb";
  const std::string mesh = refusal();
  EXPECT_NE(mesh.find("oak.glb: types[1].tree: "), std::string::npos) << mesh;
  EXPECT_NE(mesh.find("treeprep"), std::string::npos) << mesh;
}

TEST_F(Ecogen, TablesMayBeginWithAMarkAndNameAColumnOnce) {
  page_["types"][0]["count"] = page_["types"][1]["count"] = 0;
  write_text(file("t.csv"), "\xef\xbb\xbftype,x,z\na,1,2\n");
  EXPECT_EQ(run({"--instances", file("t.csv")}).status, 0);
  EXPECT_EQ(load().instance_count(), 1u);
  write_text(file("t.csv"), "type,x,z,x\na,1,2,3\n");
  const Outcome o = run({"--instances", file("t.csv")});
  EXPECT_EQ(o.status, 1);
  EXPECT_NE(o.err.find("column 'x' is there twice"), std::string::npos) << o.err;
}

TEST_F(Ecogen, OptionsThatMeanNothingTogetherAreRefused) {
  EXPECT_EQ(run_process({"ecogen", "--new", "--schema"}).status, 2);
  EXPECT_EQ(run({"--lowest-sun", "30"}).status, 2) << "without a path";
  EXPECT_EQ(run({"--widest", "3"}).status, 2) << "without a path";
  ASSERT_EQ(run().status, 0);
  const Outcome o = run_process({"treedump", file("out.eco"), file("out.eco"), "--diff", "--tolerance", "1"});
  EXPECT_EQ(o.status, 2);
  EXPECT_EQ(line_count(o.err), 1u) << o.err;
}

TEST_F(Ecogen, PagesAndSchemasGoWhereTheyAreSentTo) {
  const Outcome o = run_process({"ecogen", "--new", "-o", file("mine.json")});
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(o.out, "");
  EXPECT_EQ(read_text(file("mine.json")), run_process({"ecogen", "--new"}).out);
}

TEST_F(Ecogen, InstancesGoOutAndComeBackAsCsv) {
  ASSERT_EQ(run({"--export", file("i.csv")}).status, 0);
  const std::string csv = read_text(file("i.csv"));
  EXPECT_EQ(line_count(csv), 251u);
  page_["types"][0]["count"] = page_["types"][1]["count"] = 0;
  const Ecosystem before = load();
  const Outcome o = run({"--instances", file("i.csv"), "--export", file("j.csv")});
  ASSERT_EQ(o.status, 0) << o.err;
  const Ecosystem after = load();
  ASSERT_EQ(after.instance_count(), 250u);
  EXPECT_LE(after.position_error, 1e-4f);
  EXPECT_EQ(before.types[0].instances, after.types[0].instances);
  for (const auto& [text, what] : {std::pair("type,x,z\na,1\n", "line 2: 2 fields"),
                                   {"type,x,zz\n", "column 'zz' is unknown"},
                                   {"type,x\n", "no column 'z'"},
                                   {"type,x,z\nq,1,1\n", "no type called 'q'"},
                                   {"type,x,z\na,1,one\n", "z 'one'"},
                                   {"type,x,z,scale\na,1,1,-2\n", "scale '-2'"},
                                   {"type,x,z\n\"a,1,1\n", "quote"}}) {
    write_text(file("bad.csv"), text);
    const Outcome bad = run({"--instances", file("bad.csv")});
    EXPECT_EQ(bad.status, 1);
    EXPECT_NE(bad.err.find(what), std::string::npos) << bad.err;
  }
}

TEST_F(Ecogen, ExportsAMapFromAbove) {
  ASSERT_EQ(run({"--export", file("map.png")}).status, 0);
  const auto image = read_image(file("map.png"));
  ASSERT_TRUE(image);
  EXPECT_EQ(image->height, 683);  // 60 x 40 m
  EXPECT_GT(image->width, 1024 + 100);
  // Its legend says something: there is ink on the white beside the map.
  std::size_t ink = 0;
  for (int y = 0; y < image->height; ++y)
    for (int x = 1024; x < image->width; ++x)
      ink += image->rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image->width) +
                              static_cast<std::size_t>(x))] < 128;
  EXPECT_GT(ink, 1000u);
  EXPECT_EQ(run({"--export", file("map.jpeg2")}).status, 2);
}

TEST_F(Ecogen, ExportsObjOfSmallForests) {
  page_["types"][0]["count"] = 2;
  page_["types"][1]["count"] = 1;
  ASSERT_EQ(run({"--export", file("f.obj")}).status, 0);
  const std::string obj = read_text(file("f.obj"));
  for (const char* object : {"terrain", "a 1", "a 2", "b 3"})
    EXPECT_NE(obj.find(std::string("o ") + object), std::string::npos) << object;
}

TEST_F(Ecogen, AnExportFindsItsImagesFromItsOwnFolder) {
  Image image;
  image.width = image.height = 1;
  image.rgba = {255, 0, 0, 255};
  ASSERT_TRUE(write_image(file("soil.png"), image));
  page_["materials"][0]["texture"] = "soil.png";
  page_["types"][0]["count"] = 1;
  std::filesystem::create_directories(file("else"));
  ASSERT_EQ(
      run({"--export", file("f.obj"), "--export", file("else/g.obj"), "--export", file("else/g.glb")}).status,
      0);
  EXPECT_NE(read_text(file("f.mtl")).find("map_Kd soil.png\n"), std::string::npos);
  EXPECT_NE(read_text(file("else/g.mtl")).find("map_Kd ../soil.png\n"), std::string::npos);
  EXPECT_NE(read_text(file("else/g.glb")).find("\"../soil.png\""), std::string::npos);
}

// The judge is the Khronos validator, where node and the npm package `gltf-validator` are.
TEST_F(Ecogen, ExportsAGlbThatTheKhronosValidatorAccepts) {
  page_["types"][0]["instances"] = Json::parse(R"([{"x": 5, "z": 5, "tint": [255, 0, 188]}])");
  ASSERT_EQ(run({"--export", file("f.glb")}).status, 0);
  ASSERT_EQ(run({"--export", file("n.glb"), "--glb-nodes"}).status, 0);
  write_text(file("check.js"), R"(const v = require('gltf-validator'), fs = require('fs');
v.validateBytes(new Uint8Array(fs.readFileSync(process.argv[2]))).then(r => {
  // The images of these trees are names alone: that they cannot be read is no fault of the GLB.
  const errors = r.issues.messages.filter(m => m.severity == 0 && m.code != 'IO_ERROR');
  console.log(errors.length, JSON.stringify(errors).slice(0, 500)); });)");
  const Outcome root = run_process({"/bin/sh", "-c", "npm root -g 2>/dev/null"});
  const std::string modules = root.out.substr(0, root.out.find('\n'));
  const char* own = std::getenv("NODE_PATH");
  for (const char* name : {"f.glb", "n.glb"}) {
    const std::string glb = read_text(file(name));
    const std::string json = glb.substr(20, glb.find("BIN", 20) - 24);
    EXPECT_TRUE(Json::parse(json)["meshes"][0]["primitives"][0]["attributes"].contains("NORMAL"))
        << "terrain";
    const Outcome o = run_process({"/bin/sh", "-c", "node '" + file("check.js") + "' '" + file(name) + "'"},
                                  {"NODE_PATH=" + (own ? std::string(own) + ":" : "") + modules});
    if (o.err.find("Cannot find module") != std::string::npos || o.status == 127)
      GTEST_SKIP()
          << "node or gltf-validator could not be had: `./run test` installs them (cmake/debian-judges.txt)";
    EXPECT_EQ(o.status, 0) << o.err;
    EXPECT_EQ(o.out.substr(0, 2), "0 ") << o.out;
  }
}

// Blender before 3.6 does not know EXT_mesh_gpu_instancing; every version opens nodes.
TEST_F(Ecogen, BlenderOpensAGlbOfNodes) {
  if (run_process({"/bin/sh", "-c", "command -v blender"}).status != 0)
    GTEST_SKIP() << "Blender could not be had: `./run test` installs it (cmake/debian-judges.txt)";
  page_["types"][0]["count"] = 3;
  page_["types"][1]["count"] = 2;
  ASSERT_EQ(run({"--export", file("n.glb"), "--glb-nodes"}).status, 0);
  // Blender 3.4 of Debian 12 asks for numpy.bool, which numpy of Debian 12 does not have any more.
  write_text(file("open.py"), R"(import bpy, numpy, sys
if 'bool' not in vars(numpy): numpy.bool = bool
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=sys.argv[-1])
shown = [o for o in bpy.data.objects if o.type == 'MESH']
print('opened', len(shown), 'of', len({o.data.name for o in shown}))
)");
  const Outcome o = run_process({"/bin/sh", "-c",
                                 "blender --background --factory-startup --python '" + file("open.py") +
                                     "' -- '" + file("n.glb") + "'"});
  EXPECT_NE(o.out.find("opened 6 of 3"), std::string::npos) << o.out << o.err;  // five trees and a terrain
}

TEST_F(Ecogen, WhatNoFrameShowsIsLeftOut) {
  write_text(
      file("path.json"),
      R"({"schema":"copse.path/1","keys":[{"time":0,"eye":[0,5,20],"target":[-10,5,20]},{"time":1,"eye":[10,5,20],"target":[0,5,20]}]})");
  for (auto& type : page_["types"]) type["scale"] = 1e-4;  // little trees: what counts is where they stand
  ASSERT_EQ(run({"--camera-path", file("path.json")}).status, 0);
  const Ecosystem eco = load();
  EXPECT_LT(eco.instance_count(), 120u);  // it looks west all the time
  for (const InstanceBlock& b : eco.blocks)
    for (std::size_t i = b.first; i < b.first + b.count; ++i)
      EXPECT_LT(instance_of(eco, b, i).position.x, 25);
}

// Looking north, what stands to the left and the right is in wide frames alone.
TEST_F(Ecogen, WiderFramesKeepMore) {
  write_text(
      file("path.json"),
      R"({"schema":"copse.path/1","fov":20,"keys":[{"time":0,"eye":[20,2,39],"target":[20,2,0]},{"time":1,"eye":[20,2,39],"target":[20,2,0]}]})");
  for (auto& type : page_["types"]) type["scale"] = 1e-4;
  std::vector<std::size_t> kept;
  for (const char* widest : {"1", "2.4", "5"}) {
    ASSERT_EQ(run({"--camera-path", file("path.json"), "--lowest-sun", "90", "--widest", widest}).status, 0);
    kept.push_back(load().instance_count());
  }
  EXPECT_LT(kept[0], kept[1]);
  EXPECT_LT(kept[1], kept[2]);
}

// The camera looks west from x = 20; east of it stand trees whose shadows a low sun throws past it.
TEST_F(Ecogen, TreesWhoseShadowsMayFallIntoAFrameStay) {
  write_text(
      file("path.json"),
      R"({"schema":"copse.path/1","keys":[{"time":0,"eye":[20,3,20],"target":[0,0,20]},{"time":1,"eye":[20,3,20],"target":[0,0,20]}]})");
  std::vector<std::size_t> kept;
  for (const char* sun : {"90", "30", "5"}) {
    ASSERT_EQ(
        run({"--camera-path", file("path.json"), "--lowest-sun", sun, "--report", file("r.json")}).status, 0);
    kept.push_back(load().instance_count());
    EXPECT_NE(read_text(file("r.json")).find(std::string("at least ") + sun + " degrees"), std::string::npos);
  }
  EXPECT_LT(kept[0], kept[2]);
  EXPECT_LE(kept[0], kept[1]);
  EXPECT_LE(kept[1], kept[2]);
  EXPECT_LT(kept[2], 250u);
}

TEST_F(Ecogen, TheReportTellsWhatTheFileSavesFromWhatNeedNotBeRead) {
  page_["types"][1]["count"] = 0;
  const auto size = std::filesystem::file_size(file("b.tree"));
  for (const bool pack : {false, true}) {
    std::vector<std::string> more{"--report", file("r.json")};
    if (pack) more.emplace_back("--pack");
    ASSERT_EQ(run(more).status, 0);
    const Json report = Json::parse(read_text(file("r.json")));
    bool found = false;
    for (const auto& table : report["tables"])
      for (const auto& row : table["rows"]) {
        if (table["name"] != "left out" || row[0] != "type 'b'") continue;
        found = true;
        EXPECT_EQ(row[2], std::to_string(65 + (pack ? size : 0)));
        EXPECT_EQ(row[3], std::to_string(pack ? 0 : size));
      }
    EXPECT_TRUE(found);
  }
}

TEST_F(Ecogen, ANumberWithoutAFractionIsWhole) {
  page_["types"][0]["count"] = 200.0;
  page_["seed"] = 3.0;
  ASSERT_EQ(run().status, 0);
  EXPECT_EQ(load().types[0].instances, 200u);
  EXPECT_EQ(load().seed, 3u);
  page_["types"][0]["count"] = 200.5;
  std::filesystem::remove(file("out.eco"));
  EXPECT_NE(refusal().find("types[0].count: 200.5"), std::string::npos);
}

TEST_F(Ecogen, ThePageIsNotWrittenUnderTheNameOfAnEcosystem) {
  const Outcome o = run_process({"ecogen", "--new", "-o", file("out.eco")});
  EXPECT_EQ(o.status, 2);
  EXPECT_EQ(line_count(o.err), 1u);
  EXPECT_FALSE(std::filesystem::exists(file("out.eco")));
  EXPECT_EQ(run_process({"ecogen", "--new", "-o", file("new.json")}).status, 0);
}

TEST_F(Ecogen, TexturesOfThePageGiveItsMaterialsTheirMeanColour) {
  Image image;
  image.width = image.height = 2;
  image.rgba = {255, 0, 0, 255, 255, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255};
  ASSERT_TRUE(write_image(file("half.png"), image));
  page_["materials"][0]["texture"] = "half.png";
  ASSERT_EQ(run().status, 0);
  const Float3 mean = load().materials[0].mean_colour;
  EXPECT_NEAR(mean.x, 0.5, 1e-3);
  EXPECT_EQ(mean.y, 0);
  std::filesystem::remove(file("out.eco"));
  for (const char* wrong : {"none.png", "page.json"}) {
    page_["materials"][0]["texture"] = wrong;
    const Outcome o = run();
    EXPECT_NE(o.status, 0);
    EXPECT_EQ(line_count(o.err), 1u) << o.err;
    EXPECT_NE(o.err.find("materials[0].texture: "), std::string::npos) << o.err;
  }
}

TEST_F(Ecogen, ProvenanceHasTheOptionsAndTheSources) {
  write_text(
      file("path.json"),
      R"({"schema":"copse.path/1","keys":[{"time":0,"eye":[0,5,20],"target":[10,5,20]},{"time":1,"eye":[10,5,20],"target":[50,5,20]}]})");
  ASSERT_EQ(run({"--camera-path", file("path.json"), "--view-range", "50", "--compress"}).status, 0);
  const Json told = Json::parse(load().provenance);
  EXPECT_EQ(told["options"]["view-range"], 50);
  EXPECT_EQ(told["options"]["compress"], true);
  EXPECT_EQ(told["options"]["camera-path"], "path.json");
  EXPECT_EQ(told["options"]["lowest-sun"], 20);
  EXPECT_EQ(told["options"]["widest"], 2.4);
  EXPECT_EQ(told["sources"][1]["name"], "path.json");
  EXPECT_EQ(told["sources"].size(), 2u);
}

TEST_F(Ecogen, WhatIsBeyondItsViewRangeInEveryFrameIsLeftOut) {
  write_text(
      file("path.json"),
      R"({"schema":"copse.path/1","keys":[{"time":0,"eye":[30,1,20],"target":[0,1,20]},{"time":1,"eye":[31,1,20],"target":[60,1,21]}]})");
  page_["types"][0]["scale"] = page_["types"][1]["scale"] = 1e-4;
  page_["types"][0]["view_range"] = 12;
  ASSERT_EQ(run({"--camera-path", file("path.json"), "--report", file("r.json")}).status, 0);
  const Ecosystem eco = load();
  double farthest[2] = {};
  for (const InstanceBlock& b : eco.blocks)
    for (std::size_t i = b.first; i < b.first + b.count; ++i) {
      const Double3 p = instance_of(eco, b, i).position;
      double& most = farthest[eco.types[b.type].name == "b"];
      most = std::max(most, std::hypot(p.x - 30.5, p.z - 20));
    }
  EXPECT_LT(farthest[0], 14);  // 12, a part of the ground and what the camera moves
  EXPECT_GT(farthest[1], 20);  // no limit
  EXPECT_NE(read_text(file("r.json")).find("no frame of the camera's path shows them"), std::string::npos);
}

}  // namespace
}  // namespace copse
