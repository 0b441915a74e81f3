// treegrow as a user calls it.
#include "lib/formats/import/import.h"
#include "tests/tools/process.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

namespace copse {
namespace {

std::string contents(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::set<std::string> names_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) names.insert(entry.path().filename());
  return names;
}

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST(Treegrow, WritesAnObjWithItsMaterialsAndTexturesBesideIt) {
  const TemporaryFolder folder;
  const Outcome run = run_process({"treegrow", "birch", "-o", folder.file("b.obj"), "--triangles", "3000",
                                   "--texture-size", "64", "--truth", folder.file("b.json")});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(names_in(folder.path()),
            (std::set<std::string>{"b.obj", "b.mtl", "b_texture0.png", "b_texture1.png", "b.json"}));
  const auto import = import_mesh(folder.file("b.obj"));
  ASSERT_TRUE(import) << import.error().what;
  EXPECT_TRUE(import->warnings.empty() || import->counts.cut_polygons > 0);
  EXPECT_EQ(import->counts.dropped_faces, 0u);
  EXPECT_NEAR(static_cast<double>(import->mesh.triangles.size()), 3000, 60);
  ASSERT_EQ(import->mesh.materials.size(), 2u);
  EXPECT_NE(import->mesh.materials[1].texture, k_none);
  EXPECT_NE(contents(folder.file("b.json")).find("\"mesh\":\"b.obj\""), std::string::npos);
}

TEST(Treegrow, WritesAGlbThatHoldsItsTextures) {
  const TemporaryFolder folder;
  const Outcome run =
      run_process({"treegrow", "palm", "-o", folder.file("p.glb"), "--strict-model", "--texture-size", "64"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(names_in(folder.path()), std::set<std::string>{"p.glb"});
  const auto import = import_mesh(folder.file("p.glb"));
  ASSERT_TRUE(import) << import.error().what;
  ASSERT_EQ(import->mesh.textures.size(), 2u);
  EXPECT_FALSE(import->mesh.textures[1].bytes.empty());
  EXPECT_GT(import->mesh.materials[1].alpha_cutoff, 0);
  EXPECT_TRUE(import->mesh.materials[1].double_sided);
}

TEST(Treegrow, TheSameCallWritesTheSameBytes) {
  const TemporaryFolder a, b;
  for (const TemporaryFolder* folder : {&a, &b}) {
    const std::string jobs = folder == &a ? "1" : "4";
    const Outcome run =
        run_process({"treegrow", "oak", "-o", folder->file("t.glb"), "--truth", folder->file("t.json.gz"),
                     "--seed", "5", "--triangles", "6000", "--texture-size", "64", "-j", jobs});
    ASSERT_EQ(run.status, 0) << run.err;
  }
  EXPECT_EQ(contents(a.file("t.glb")), contents(b.file("t.glb")));
  EXPECT_EQ(contents(a.file("t.json.gz")), contents(b.file("t.json.gz")));
  EXPECT_EQ(contents(a.file("t.json.gz")).substr(0, 2), "\x1f\x8b");
}

TEST(Treegrow, ListsPrintsAndReadsSpecies) {
  const TemporaryFolder folder;
  const Outcome list = run_process({"treegrow", "--list"}),
                breaks = run_process({"treegrow", "--list-breaks"}),
                print = run_process({"treegrow", "--print", "willow"});
  EXPECT_EQ(list.status + breaks.status + print.status, 0);
  EXPECT_GE(lines_of(list.out), 8u);
  EXPECT_GE(lines_of(breaks.out), 40u);
  std::ofstream(folder.file("mine.toml")) << print.out;
  const Outcome named =
      run_process({"treegrow", "willow", "-o", folder.file("a.ply"), "--no-textures", "--seed", "3"});
  const Outcome mine =
      run_process({"treegrow", "--params", folder.file("mine.toml"), "-o", folder.file("b.ply"),
                   "--no-textures", "--seed", "3", "--depfile", folder.file("b.d")});
  ASSERT_EQ(named.status + mine.status, 0) << named.err << mine.err;
  EXPECT_EQ(contents(folder.file("a.ply")), contents(folder.file("b.ply")));
  EXPECT_NE(contents(folder.file("b.d")).find("mine.toml"), std::string::npos);
}

struct Mistake {
  std::vector<std::string> arguments;
  int status;
  const char* says;
};

TEST(Treegrow, MistakesAreOneLineAndTheRightStatusAndWriteNothing) {
  const TemporaryFolder folder;
  std::ofstream(folder.file("bad.toml")) << "base = \"oak\"\nhieght = 3\n";
  const std::string out = folder.file("t.obj");
  const Mistake mistakes[] = {
      {{}, 2, "no output is named"},
      {{"oak"}, 2, "no output is named"},
      {{"-o", out}, 2, "no species is named"},
      {{"yew", "-o", out}, 2, "there is no species called 'yew'; choose one of oak"},
      {{"oak", "-o", folder.file("t.fbx")}, 2, "use .obj, .ply or .glb"},
      {{"oak", "-o", out, "--break", "glass"}, 2, "there is no way to break a mesh called 'glass'"},
      {{"oak", "-o", out, "--break", "discs,fronds"}, 2, "exclude one another"},
      {{"oak", "-o", out, "--break", "discs", "--strict-model"}, 2, "excludes"},
      {{"oak", "-o", out, "--triangles", "9"}, 4, "cannot be met: the nearest oak has"},
      {{"oak", "-o", out, "--triangles", "0"}, 2, "--triangles"},
      {{"oak", "-o", out, "--height", "-3"}, 2, "--height"},
      {{"oak", "-o", out, "--height", "nan"}, 2, "'nan' is not a number from 0.001 to 10000"},
      {{"oak", "-o", out, "--texture-size", "100"}, 2, "is not 64, 128"},
      {{"--params", folder.file("bad.toml"), "-o", out}, 1, "line 2: there is no parameter 'hieght'"},
      {{"--params", folder.file("none.toml"), "-o", out}, 3, "none.toml"},
      {{"--params", "/dev/zero", "-o", out}, 3, "is not a file"},
      {{"--params", folder.path().string(), "-o", out}, 3, "is a folder"},
      {{"oak", "-o", out, "--truth", folder.file("t.txt")}, 2, "NAME.json or NAME.json.gz"},
      {{"--print", "yew"}, 2, "there is no species called 'yew'"},
      {{"oak", "-o", folder.file("no/such/folder/t.obj"), "--no-textures"}, 3, "make the folder first"},
  };
  for (const Mistake& mistake : mistakes) {
    std::vector<std::string> command{"treegrow"};
    command.insert(command.end(), mistake.arguments.begin(), mistake.arguments.end());
    const Outcome run = run_process(command);
    EXPECT_EQ(run.status, mistake.status) << run.err;
    EXPECT_NE(run.err.find(mistake.says), std::string::npos) << run.err;
    EXPECT_EQ(run.err.rfind("treegrow: error: ", 0), 0u) << run.err;
    EXPECT_EQ(lines_of(run.err), 1u) << run.err;
    EXPECT_EQ(names_in(folder.path()), std::set<std::string>{"bad.toml"});
  }
}

TEST(Treegrow, SaysWhenAFormatCannotHoldQuads) {
  const TemporaryFolder folder;
  const Outcome asked = run_process(
      {"treegrow", "birch", "-o", folder.file("t.ply"), "--break", "quads", "--triangles", "3000"});
  EXPECT_EQ(asked.status, 0);
  EXPECT_NE(asked.err.find("only OBJ holds faces"), std::string::npos);
  const Outcome usual = run_process({"treegrow", "birch", "-o", folder.file("u.ply"), "--triangles", "3000"});
  EXPECT_EQ(usual.err, "");
}

TEST(Treegrow, EverySampleGrows) {
  std::ifstream samples(COPSE_SOURCE_DIR "/samples/trees.txt");
  std::string line;
  std::size_t count = 0;
  const TemporaryFolder folder;
  while (std::getline(samples, line)) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    std::string name, word;
    words >> name;
    std::vector<std::string> command{"treegrow"};
    while (words >> word) {
      for (const char* mark : {"@samples/", "samples/"})
        if (word.starts_with(mark)) {
          word = std::string(mark[0] == '@' ? "@" : "") + COPSE_SOURCE_DIR "/samples/" +
                 word.substr(std::string(mark).size());
          break;
        }
      command.push_back(word);
    }
    command.insert(command.end(), {"-o", folder.file(name + ".glb"), "--no-textures"});
    const Outcome run = run_process(command);
    EXPECT_EQ(run.status, 0) << line << "\n" << run.err;
    ++count;
  }
  EXPECT_GE(count, 10u);
}

TEST(Treegrow, TruthsPassTheScorersSelfTest) {
  const std::string scorer = COPSE_SOURCE_DIR "/../shared/tools/evaluate_hierarchy.py";
  if (!std::filesystem::exists(scorer)) {
    GTEST_SKIP() << scorer << " is not there: the scorer is no part of the repository";
  }
  const TemporaryFolder folder;
  std::vector<std::string> command{"/usr/bin/python3", scorer, "--selftest"};
  for (const char* list : {"none", "artist", "extruded,rough,end-to-end-turned", "inset-faces,capped-ngon",
                           "welded-forks,collapsed-rings,bent-cards"}) {
    const std::string name = folder.file(std::to_string(command.size()));
    const Outcome run = run_process({"treegrow", "cherry", "-o", name + ".ply", "--truth", name + ".json.gz",
                                     "--break", list, "--no-textures", "--triangles", "9000"});
    ASSERT_EQ(run.status, 0) << run.err;
    command.push_back(name + ".json.gz");
  }
  const Outcome scored = run_process(command);
  EXPECT_EQ(scored.status, 0) << scored.out << scored.err;
}

}  // namespace
}  // namespace copse
