// treeprep as a user calls it: real processes on real files.
#include "lib/formats/tree_file/tree_file.h"
#include "tests/tools/little_obj.h"
#include "tests/tools/process.h"

#include <cmath>
#include <filesystem>
#include <numbers>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace copse {
namespace {

class Treeprep : public testing::Test {
 protected:
  std::string input(const std::string& text, const std::string& name = "tree.obj") {
    write_text(folder_.file("none.mtl"), little_mtl());
    write_text(folder_.file(name), text);
    return folder_.file(name);
  }
  Outcome prepare(const std::string& mesh, const std::vector<std::string>& more = {},
                  const std::string& out = "out.stree") {
    std::vector<std::string> command{"treeprep", mesh, "-o", folder_.file(out)};
    command.insert(command.end(), more.begin(), more.end());
    return run_process(command);
  }
  Tree tree(const std::string& name = "out.stree") {
    const auto file = TreeFile::open(folder_.file(name));
    if (!file) throw std::runtime_error(file.error().what);
    EXPECT_EQ(file->verify(), std::vector<std::string>{});
    auto loaded = file->load();
    if (!loaded) throw std::runtime_error(loaded.error().what);
    return *loaded;
  }
  bool written(const std::string& name = "out.stree") { return std::filesystem::exists(folder_.file(name)); }
  // Exit status, one line, nothing written.
  void expect_refused(const Outcome& o, int status, const std::string& part) {
    EXPECT_EQ(o.status, status) << o.err;
    EXPECT_NE(o.err.find("treeprep: error: "), std::string::npos) << o.err;
    EXPECT_NE(o.err.find(part), std::string::npos) << o.err;
    EXPECT_FALSE(written());
  }

  TemporaryFolder folder_;
};

TEST_F(Treeprep, RecoversALittleTreeExactly) {
  const Outcome o = prepare(input(little_tree_obj()));
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(o.out, "");
  const Tree t = tree();
  EXPECT_EQ(t.header.roots, 1u);
  EXPECT_EQ(t.header.ring_size, 6u);
  EXPECT_EQ(t.header.segment_factor, 12u);
  EXPECT_EQ(t.radius_count(), 5u);
  EXPECT_EQ(t.segment_count(), 4u);
  EXPECT_EQ(t.leaf_count(), 4u);
  EXPECT_EQ(t.leaves.groups.size(), 1u);
  EXPECT_TRUE(t.header.monotone);
  const std::vector<Double3> centres = absolute_centres(t);
  for (int r = 0; r < 5; ++r) {
    EXPECT_LT(distance(centres[r], {0, r - 1.0, 0}), 1e-6);
    EXPECT_NEAR(t.hierarchy.radii[r].diameter, 1.0 - 0.15 * r, 1e-6);
  }
}

TEST_F(Treeprep, WritesAStaticTreeWithoutAHierarchy) {
  ASSERT_EQ(prepare(input(little_tree_obj()), {}, "out.tree").status, 0);
  const Tree t = tree("out.tree");
  EXPECT_EQ(t.header.kind, TreeKind::still);
  EXPECT_TRUE(t.hierarchy.radii.empty());
  EXPECT_EQ(t.trunk.vertices.size(), 30u);
  EXPECT_EQ(t.trunk.lines.size(), 4u);
}

// A trunk of blades round a thin core: what passes for its surface is far from every branch in it.
std::string star_obj() {
  constexpr int k_corners = 10, k_rings = 4;
  std::string obj = "o trunk\n";
  for (int i = 0; i < k_corners * k_rings; ++i) {
    const double a = 2 * std::numbers::pi * i / k_corners, radius = i % 2 == 0 ? 1 : 0.05;
    obj += fmt::format("v {} {} {}\n", radius * std::cos(a), i / k_corners, radius * std::sin(a));
  }
  for (int i = 0; i < k_corners * (k_rings - 1); ++i) {
    const int a = i + 1, b = i - i % k_corners + (i + 1) % k_corners + 1;
    obj += fmt::format("f {} {} {} {}\n", a, b, b + k_corners, a + k_corners);
  }
  return obj;
}

TEST_F(Treeprep, WarnsOfATrunkThatItsBranchesDoNotExplain) {
  const Outcome star = prepare(input(star_obj()), {"--trunk", "*"});
  ASSERT_EQ(star.status, 0);
  EXPECT_THAT(star.err, ::testing::HasSubstr("% of the trunk's triangles fit none of the branches"));
  EXPECT_THAT(prepare(input(star_obj()), {"--trunk", "*", "-q"}).err, ::testing::IsEmpty());
  EXPECT_THAT(prepare(input(little_tree_obj())).err, ::testing::Not(::testing::HasSubstr("fit none")));
}

TEST_F(Treeprep, WritesTheSameBytesForAnyThreadCountAndFolder) {
  const std::string mesh = input(little_tree_obj(8, 12, 60));
  ASSERT_EQ(prepare(mesh, {"-j", "1"}, "a.stree").status, 0);
  ASSERT_EQ(prepare(mesh, {"-j", "2"}, "b.stree").status, 0);
  const TemporaryFolder elsewhere;
  std::filesystem::copy(mesh, elsewhere.file("tree.obj"));
  std::filesystem::copy(folder_.file("none.mtl"), elsewhere.file("none.mtl"));
  ASSERT_EQ(run_process({"treeprep", elsewhere.file("tree.obj"), "-o", folder_.file("c.stree")}).status, 0);
  const std::string bytes = read_text(folder_.file("a.stree"));
  EXPECT_FALSE(bytes.empty());
  EXPECT_EQ(bytes, read_text(folder_.file("b.stree")));
  EXPECT_EQ(bytes, read_text(folder_.file("c.stree")));
}

TEST_F(Treeprep, AcceptsWhatObeysTheStrictModel) {
  // The rules ask for a texture of trunk and leaves.
  write_text(folder_.file("bark.png"), "");
  const std::string mesh = input(little_tree_obj());
  write_text(folder_.file("none.mtl"), "newmtl bark\nmap_Kd bark.png\nnewmtl leaf\nmap_Kd bark.png\n");
  const Outcome o = prepare(mesh, {"--strict", "--omit", "textures"});
  EXPECT_EQ(o.status, 0) << o.err;
}

TEST_F(Treeprep, NamesEveryBreachOfTheStrictModel) {
  // No textures, and a quad for a leaf.
  const Outcome o =
      prepare(input(little_tree_obj(5, 4, 3, "v 9 9 9\nv 10 9 9\nv 10 10 9\nv 9 10 9\nf -4 -3 -2 -1\n")),
              {"--strict"});
  EXPECT_EQ(o.status, 1);
  EXPECT_EQ(line_count(o.err), 1u) << o.err;
  EXPECT_NE(o.err.find("rules"), std::string::npos) << o.err;
  for (const char* rule : {"rule 1: ", "rule 3.1: ", "rule 4.7: "})
    EXPECT_NE(o.out.find(rule), std::string::npos) << rule << " in " << o.out;
}

TEST_F(Treeprep, NamesFaultsOfTheFileAndBreachesTogether) {
  const Outcome o = prepare(input(little_tree_obj(5, 4, 3, "f 1 2 99999\n")), {"--strict", "-q"});
  EXPECT_EQ(o.status, 1);
  EXPECT_NE(o.out.find("99999"), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("rule 4.7: "), std::string::npos) << o.out;
}

TEST_F(Treeprep, LeavesOutWhatIsNotWantedAndSaysSo) {
  ASSERT_EQ(prepare(input(little_tree_obj()), {"--omit", "leaves,lines,trunk-texcoords"}).status, 0);
  const auto file = TreeFile::open(folder_.file("out.stree"));
  ASSERT_TRUE(file);
  for (const char* gone : {"LTRI", "LGRP", "TLIN", "TTEX"}) {
    EXPECT_FALSE(file->has(gone)) << gone;
    EXPECT_NE(std::find(file->omitted().begin(), file->omitted().end(), gone), file->omitted().end()) << gone;
  }
  EXPECT_TRUE(file->has("TTRI"));
  ASSERT_EQ(prepare(input(little_tree_obj()),
                    {"--omit", "leaves,lines", "--report", folder_.file("omit.json")}, "omit.stree")
                .status,
            0);
  const std::string report = read_text(folder_.file("omit.json"));
  for (const char* told : {"\"left out\"", "TLIN", "LGRP", "never made"})
    EXPECT_NE(report.find(told), std::string::npos) << told;
  ASSERT_EQ(prepare(input(little_tree_obj()), {"--only", "lines"}, "only.stree").status, 0);
  const auto only = TreeFile::open(folder_.file("only.stree"));
  ASSERT_TRUE(only);
  EXPECT_TRUE(only->has("TLIN"));
  EXPECT_FALSE(only->has("TTRI"));
  EXPECT_LT(only->size(), file->size());
}

TEST_F(Treeprep, CapsTheNumberOfLeafGroups) {
  const std::string two_trees = little_tree_obj(6, 5, 4);
  ASSERT_EQ(prepare(input(two_trees), {"--max-leaf-groups", "1"}).status, 0);
  EXPECT_EQ(tree().leaves.groups.size(), 1u);
}

TEST_F(Treeprep, ScalesAndStandsUp) {
  ASSERT_EQ(prepare(input(little_tree_obj()), {"--scale", "0.01"}).status, 0);
  EXPECT_NEAR(tree().header.trunk_bounds.max.y, 0.03, 1e-6);
  ASSERT_EQ(prepare(input("v 0 0 -1\nv 1 0 -1\nv 0 1 -1\nv 0 0 4\nv 1 0 4\nv 0 1 4\n"
                          "f 1 4 2\nf 2 4 5\nf 2 5 3\nf 3 5 6\nf 3 6 1\nf 1 6 4\n"),
                    {"--up", "z", "--trunk", "*"}, "z.stree")
                .status,
            0);
  EXPECT_FLOAT_EQ(tree("z.stree").header.bounds.max.y, 4);
}

TEST_F(Treeprep, GivesADefinedResultForEachExtreme) {
  const std::string leaf_only =
      "v 0 1 0\nv 1 1 0\nv 0 2 0\nv 5 1 0\nv 6 1 0\nv 5 2 0\nusemtl leaf\nf 1 2 3\nf 4 5 6\n";
  ASSERT_EQ(prepare(input(leaf_only), {}, "leaves.stree").status, 0);
  EXPECT_EQ(tree("leaves.stree").leaf_count(), 2u);
  EXPECT_EQ(tree("leaves.stree").radius_count(), 0u);
  EXPECT_GE(tree("leaves.stree").leaves.groups.size(), 1u);

  ASSERT_EQ(prepare(input(little_tree_obj(6, 5, 0)), {}, "trunk.stree").status, 0);
  EXPECT_EQ(tree("trunk.stree").leaf_count(), 0u);
  EXPECT_EQ(tree("trunk.stree").radius_count(), 5u);

  const Outcome single = prepare(input("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), {}, "single.stree");
  ASSERT_EQ(single.status, 0) << single.err;
  const Tree one = tree("single.stree");
  EXPECT_EQ(one.trunk.triangles.size() + one.leaves.triangles.size(), 1u);

  const Outcome trunk_triangle =
      prepare(input("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), {"--trunk", "*"}, "single_trunk.stree");
  ASSERT_EQ(trunk_triangle.status, 0) << trunk_triangle.err;
  EXPECT_EQ(tree("single_trunk.stree").trunk.triangles.size(), 1u);
}

TEST_F(Treeprep, KeepsTheShapeOfATreeFarFromTheOrigin) {
  std::string far;
  const std::string near = little_tree_obj();
  for (std::size_t at = 0; at < near.size();) {
    const std::size_t end = near.find('\n', at);
    const std::string line = near.substr(at, end - at);
    double x = 0, y = 0, z = 0;
    if (std::sscanf(line.c_str(), "v %lf %lf %lf", &x, &y, &z) == 3) {
      far += fmt::format("v {:.6f} {:.6f} {:.6f}\n", x + 1e7, y, z - 1e7);
    } else {
      far += line + "\n";
    }
    at = end + 1;
  }
  const Outcome o = prepare(input(far));
  ASSERT_EQ(o.status, 0) << o.err;
  const Tree t = tree();
  EXPECT_EQ(t.header.ring_size, 6u);
  const std::vector<Double3> centres = absolute_centres(t);
  for (int r = 0; r < 5; ++r) {
    EXPECT_LT(distance(centres[r] + t.header.origin, {1e7, r - 1.0, -1e7}), 2e-6);
  }
}

TEST_F(Treeprep, PreparesTinyAndHugeTreesAndRefusesWhatFloat32CannotHold) {
  for (const char* scale : {"1e-30", "1e-9", "1e9", "1e17"}) {
    const Outcome o = prepare(input(little_tree_obj()), {"--scale", scale});
    ASSERT_EQ(o.status, 0) << o.err;
    EXPECT_EQ(tree().radius_count(), 5u) << scale;
    std::filesystem::remove(folder_.file("out.stree"));
  }
  for (const char* scale : {"1e30", "1e308"}) {
    expect_refused(prepare(input(little_tree_obj()), {"--scale", scale}), 1, "--scale");
  }
}

TEST_F(Treeprep, PreparesAVineOfAHundredThousandSegments) {
  const Outcome o = prepare(input(little_tree_obj(3, 100001, 1)), {"--trunk", "bark", "--leaf", "leaf"});
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(tree().radius_count(), 100001u);
}

TEST_F(Treeprep, HelpNamesEveryOption) {
  const std::string help = run_process({"treeprep", "--help"}, {"COLUMNS=100"}).out;
  for (const char* option : {"--up y|z", "--scale N", "--weld EPS", "--strict", "--trunk PATTERN",
                             "--leaf PATTERN", "--skeleton auto|rings|surface", "--root X,Y,Z",
                             "--max-leaf-groups N", "--leaf-order group|terminal|random", "--omit PART",
                             "--only PART", "--compress none|zstd", "--report FILE"}) {
    EXPECT_NE(help.find(option), std::string::npos) << option << "\n" << help;
  }
  EXPECT_EQ(help.find("[-1]"), std::string::npos) << help;  // what stands for "none" inside is no default
  EXPECT_NE(help.find(" leaf-normals: normals of the leaves\n"), std::string::npos) << help;
}

TEST_F(Treeprep, BeginsWhereItIsTold) {
  const std::string mesh = input(little_tree_obj());
  ASSERT_EQ(prepare(mesh, {"--root", "-0.5,9,0"}).status, 0);
  EXPECT_LT(distance(absolute_centres(tree())[0], {0, 3, 0}), 1e-6);
  EXPECT_EQ(tree().header.roots, 1u);
  ASSERT_EQ(prepare(mesh, {"--root", "0,3,0", "--root", "0,-1,0"}).status, 0);  // one limb has one root
  EXPECT_LT(distance(absolute_centres(tree())[0], {0, 3, 0}), 1e-6);
}

TEST_F(Treeprep, RefusesRootsThatAreNoPoints) {
  const std::string mesh = input(little_tree_obj());
  for (const std::string value : {"", "1,2", "1,2,3,4", "1,2,nan", "1,2,inf", "1;2;3", "1,2,", "a,b,c"}) {
    const Outcome o = prepare(mesh, {"--root=" + value});
    expect_refused(o, 2, "--root");
    EXPECT_EQ(line_count(o.err), 1u) << o.err;
  }
}

TEST_F(Treeprep, RefusesNumbersThatAreNone) {
  const std::string mesh = input(little_tree_obj());
  for (const char* option : {"--scale", "--weld", "--max-leaf-groups"}) {
    for (const char* value : {"nan", "inf", "-1", "1e999"}) {
      expect_refused(prepare(mesh, {option, value}), 2, std::string(option) + ": '" + value + "' is not a");
    }
  }
  expect_refused(prepare(mesh, {"--scale", "1e308"}), 1, "use a smaller --scale");
  expect_refused(prepare(mesh, {"--up", "1"}), 2, "--up: 1 not in {y,z}");
}

TEST_F(Treeprep, RefusesWithOneLineAndWritesNothing) {
  expect_refused(prepare(folder_.file("missing.obj")), 3, "missing.obj");
  expect_refused(prepare(input("# nothing\n", "empty.obj")), 1, "empty.obj");
  expect_refused(prepare(input("v 0 nan 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "nan.obj")), 1, "nan.obj");
  expect_refused(prepare(input(little_tree_obj()), {}, "out.xyz"), 2, ".stree");
  expect_refused(prepare(input(little_tree_obj()), {"--omit", "bananas"}), 2, "bananas");
  expect_refused(prepare(input(little_tree_obj()), {"--omit", "lines", "--only", "lines"}), 2, "--only");
  expect_refused(prepare(input(little_tree_obj()), {"--trunk", "bananas*"}), 2, "bananas");
  expect_refused(prepare(input(little_tree_obj()), {"--scale", "-1"}), 2, "--scale");
  EXPECT_EQ(line_count(prepare(input("# nothing\n", "empty.obj")).err), 1u);
  EXPECT_EQ(run_process({"treeprep", input(little_tree_obj()), "-o", folder_.file("no/such/folder/x.stree")})
                .status,
            3);
}

TEST_F(Treeprep, ReportsWhatItFoundAndHowWrongItIs) {
  const Outcome o =
      prepare(input(little_tree_obj()), {"--report", folder_.file("r.json"), "--html", folder_.file("r.html"),
                                         "--depfile", folder_.file("r.d")});
  ASSERT_EQ(o.status, 0) << o.err;
  const std::string json = read_text(folder_.file("r.json"));
  for (const char* part : {"copse.report/1", "\"treeprep\"", "\"read\"", "\"classify\"", "\"skeleton\"",
                           "\"leaf groups\"", "cylinder-surface of local radius",
                           "trunk triangles unexplained", "what was found", "trunk and leaves, and why"}) {
    EXPECT_NE(json.find(part), std::string::npos) << part;
  }
  const std::string html = read_text(folder_.file("r.html"));
  EXPECT_NE(html.find("Skeleton over the mesh"), std::string::npos);
  EXPECT_NE(html.find("<svg"), std::string::npos);
  const std::string dependencies = read_text(folder_.file("r.d"));
  EXPECT_NE(dependencies.find("tree.obj"), std::string::npos);
  EXPECT_NE(dependencies.find("none.mtl"), std::string::npos);
}

// Square tubes about axes along x or y.
std::string square_tube(std::size_t& vertices, const Double3& from, const Double3& step, int rings,
                        double radius) {
  std::string obj;
  const Double3 side = step.x != 0 ? Double3{0, 1, 0} : Double3{1, 0, 0}, up{0, 0, 1};
  for (int r = 0; r < rings; ++r)
    for (int i = 0; i < 4; ++i) {
      const Double3 p =
          from + step * r + (side * (i == 0 || i == 3 ? 1.0 : -1.0) + up * (i < 2 ? 1.0 : -1.0)) * radius;
      obj += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
    }
  for (int r = 0; r + 1 < rings; ++r)
    for (int i = 0; i < 4; ++i) {
      const std::size_t a = vertices + 1 + 4 * r + i, b = vertices + 1 + 4 * r + (i + 1) % 4;
      obj += fmt::format("f {} {} {} {}\n", a, b, b + 4, a + 4);
    }
  vertices += 4 * static_cast<std::size_t>(rings);
  return obj;
}

TEST_F(Treeprep, SaysWhereLimbsBeginInTheAir) {
  std::size_t vertices = 0;
  std::string obj = "usemtl bark\n" + square_tube(vertices, {0, 0, 0}, {0, 0.5, 0}, 12, 0.2) +
                    square_tube(vertices, {0, 3, 0}, {0.5, 0, 0}, 8, 0.1);
  EXPECT_EQ(prepare(input(obj)).err.find("in the air"), std::string::npos);
  const std::string bough = square_tube(vertices, {1, 3.06, 0}, {0, 0.3, 0}, 3, 0.02);
  EXPECT_EQ(prepare(input(obj + bough)).err.find("in the air"), std::string::npos);
  const Outcome o = prepare(input(obj + bough + square_tube(vertices, {2, 4.5, 0}, {0, 0.3, 0}, 3, 0.02)));
  EXPECT_EQ(o.status, 0);
  EXPECT_NE(o.err.find("1 of the limbs begins in the air"), std::string::npos) << o.err;
}

TEST_F(Treeprep, ReadsAPipeOnceAndClaimsNoHashOfIt) {
  input(little_tree_obj());
  const Outcome o =
      run_process({"/bin/sh", "-c",
                   "cd '" + folder_.path().string() +
                       "' && mkfifo mesh.pipe && (cat tree.obj > mesh.pipe &) && timeout 20 " +
                       std::string(COPSE_BIN_DIR) + "/treeprep mesh.pipe -o out.stree --report r.json"});
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(tree().radius_count(), 5u);
  EXPECT_EQ(read_text(folder_.file("out.stree")).find("xxh3:"), std::string::npos);
  EXPECT_NE(read_text(folder_.file("out.stree")).find(R"("sources":[{"name":"mesh.pipe"}])"),
            std::string::npos);
}

TEST_F(Treeprep, MakesOneTreeOfSeveralMeshes) {
  const std::string trunk = input(little_tree_obj(6, 5, 0), "trunk.obj");
  const std::string leaves = input("v 0 4 0\nv 1 4 0\nv 0 5 0\nusemtl leaf\nf 1 2 3\n", "leaves.obj");
  const Outcome o = run_process({"treeprep", trunk, leaves, "-o", folder_.file("out.stree")});
  ASSERT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(tree().radius_count(), 5u);
  EXPECT_EQ(tree().leaf_count(), 1u);
}

}  // namespace
}  // namespace copse
