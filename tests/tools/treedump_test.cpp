#include "lib/formats/container/atomic_file.h"
#include "lib/formats/import/import.h"
#include "lib/formats/tree_file/tree_file.h"
#include "tests/formats/tampering.h"
#include "tests/formats/tree_maker.h"
#include "tests/tools/process.h"

#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace copse {
namespace {

using nlohmann::json;

class Treedump : public testing::Test {
 protected:
  static Tree sensitive() { return make_tree({.ring = 6, .segment = 12, .leaf = 2}, 1); }
  static Tree still() { return make_tree({.kind = TreeKind::still}, 2); }

  std::string save(const std::string& name, const Tree& tree, const WriteOptions& options = {}) const {
    const auto bytes = encode_tree(tree, options);
    EXPECT_TRUE(bytes) << bytes.error().what;
    return save(name, *bytes);
  }
  std::string save(const std::string& name, const std::vector<std::uint8_t>& bytes) const {
    EXPECT_TRUE(write_file(folder_.path() / name, std::span<const std::uint8_t>(bytes)));
    return folder_.file(name);
  }
  static Outcome dump(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "treedump");
    return run_process(arguments);
  }
  // The file with one byte of a section flipped, checksums left as they are.
  static std::vector<std::uint8_t> damaged(const Tree& tree, const std::string& section) {
    std::vector<std::uint8_t> bytes = *encode_tree(tree);
    bytes[tampering::section_at(bytes, section) + 1] ^= 0x10;
    return bytes;
  }

  TemporaryFolder folder_;
};

TEST_F(Treedump, TellsAPersonWhatIsInTheFile) {
  Tree tree = sensitive();
  tree.provenance = R"({"tool":"treeprep","version":"0.1.0","sources":[{"name":"oak.glb"}]})";
  const Outcome o = dump({save("oak.stree", tree)});
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_EQ(o.err, "");
  for (const char* part : {"sensitive tree (.stree)", "14 radii", "2 roots", "11 leaves", "4 groups",
                           "treeprep 0.1.0 from oak.glb", "TTRI", "trunk triangles"}) {
    EXPECT_NE(o.out.find(part), std::string::npos) << part << "\n" << o.out;
  }
  for (std::size_t at = 0; at < o.out.size();) {
    const std::size_t end = o.out.find('\n', at);
    EXPECT_LE(end - at, 100u) << o.out.substr(at, end - at);
    at = end + 1;
  }
}

TEST_F(Treedump, TellsWhatWasLeftOutAndWhatThatSaved) {
  const std::string file = save("oak.stree", sensitive(), {.omit = {"LNRM"}});
  EXPECT_NE(dump({file}).out.find("Left out on purpose, which saved 108 B"), std::string::npos)
      << dump({file}).out;
  const json left_out = json::parse(dump({file, "--json"}).out)["left_out"];
  ASSERT_EQ(left_out.size(), 1u);
  EXPECT_EQ(left_out[0]["name"], "LNRM");
  EXPECT_EQ(left_out[0]["saved_bytes"], 108);
}

TEST_F(Treedump, JsonHoldsHeaderCountsMaterialsAndSections) {
  const Tree tree = sensitive();
  const Outcome o = dump({save("oak.stree", tree, {.encoding = Encoding::zstd}), "--json"});
  EXPECT_EQ(o.status, 0);
  const json j = json::parse(o.out);
  EXPECT_EQ(j["schema"], "copse.dump/1");
  EXPECT_EQ(j["header"]["kind"], "stree");
  EXPECT_EQ(j["header"]["ring_size"], 6);
  EXPECT_EQ(j["counts"]["radii"], 14);
  EXPECT_EQ(j["materials"].size(), tree.materials.size());
  EXPECT_EQ(j["sections"][0]["name"], "HEAD");
  EXPECT_FALSE(j.contains("arrays"));
  EXPECT_EQ(j["header"]["bounds"]["min"][1].get<float>(), tree.header.bounds.min.y);
}

TEST_F(Treedump, ArraysComeToTheBit) {
  const Tree tree = sensitive();
  const json arrays = json::parse(dump({save("oak.stree", tree), "--json", "--arrays"}).out)["arrays"];
  ASSERT_EQ(arrays["LVTX"].size(), tree.leaves.vertices.size());
  for (std::size_t v = 0; v < tree.leaves.vertices.size(); ++v) {
    EXPECT_EQ(arrays["LVTX"][v][2].get<float>(), tree.leaves.vertices[v].z);
  }
  ASSERT_EQ(arrays["RADI"].size(), 14u);
  EXPECT_EQ(arrays["RADI"][3]["first_child"].get<std::uint32_t>(), tree.hierarchy.radii[3].first_child);
  EXPECT_EQ(arrays["TTRI"][0]["vertex"][1].get<std::uint32_t>(), tree.trunk.triangles[0].vertex[1]);
  EXPECT_EQ(arrays["TACC"].back().get<double>(),
            tree.trunk.accumulated_lengths[tree.trunk.accumulated_lengths.size() - 1]);
}

TEST_F(Treedump, HierarchyIsAbsoluteAndKeepsItsSchema) {
  Tree tree = sensitive();
  tree.header.origin = {1e6, 2, -3};
  const Outcome o = dump({save("oak.stree", tree), "--hierarchy"});
  ASSERT_EQ(o.status, 0) << o.err;
  const json j = json::parse(o.out);
  ASSERT_EQ(j.size(), 2u);
  const std::vector<Double3> centres = absolute_centres(tree);
  const std::vector<std::uint32_t> parent = parents(tree);
  ASSERT_EQ(j["radii"].size(), centres.size());
  for (std::size_t r = 0; r < centres.size(); ++r) {
    const json& radius = j["radii"][r];
    EXPECT_EQ(radius["center"][0].get<double>(), 1e6 + centres[r].x);
    EXPECT_EQ(radius["center"][2].get<double>(), -3 + centres[r].z);
    EXPECT_EQ(radius["diameter"].get<float>(), tree.hierarchy.radii[r].diameter);
    EXPECT_EQ(radius["parent"].get<int>(), parent[r] == k_none ? -1 : static_cast<int>(parent[r]));
  }
  ASSERT_EQ(j["leaf_groups"].size(), tree.leaves.groups.size());
  for (std::size_t g = 0; g < tree.leaves.groups.size(); ++g) {
    const json& group = j["leaf_groups"][g];
    EXPECT_EQ(group["leaves"].get<std::uint32_t>(), tree.leaves.groups[g].count);
    const Radius& radius = tree.hierarchy.radii[group["radius_index"].get<std::size_t>()];
    EXPECT_NE(radius.flags & Radius::terminal, 0u);
    EXPECT_EQ(radius.first_child, g);
  }
}

TEST_F(Treedump, ATreeWithoutHierarchyIsRefusedWithARemedy) {
  const Outcome o = dump({save("oak.tree", still()), "--hierarchy"});
  EXPECT_EQ(o.status, 1);
  EXPECT_EQ(o.out, "");
  EXPECT_NE(o.err.find("a .tree holds no hierarchy; make an .stree"), std::string::npos) << o.err;
  EXPECT_EQ(line_count(o.err), 1u);
}

TEST_F(Treedump, VerifyPassesSoundFilesAndListsAllThatFailsInOthers) {
  const std::string sound = save("sound.stree", sensitive());
  EXPECT_EQ(dump({sound, "--verify"}).status, 0);
  EXPECT_EQ(dump({sound, "--verify", "-q"}).out, "");
  std::vector<std::uint8_t> bytes = damaged(sensitive(), "LVTX");
  bytes[tampering::section_at(bytes, "RADI")] ^= 1;
  const std::string broken = save("broken.stree", bytes);
  const Outcome o = dump({sound, broken, "--verify"});
  EXPECT_EQ(o.status, 1);
  EXPECT_NE(o.out.find("LVTX"), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("RADI"), std::string::npos) << o.out;
  EXPECT_EQ(line_count(o.err), 1u);
  const json j = json::parse(dump({sound, broken, "--verify", "--json"}).out);
  EXPECT_EQ(j["files"][0]["sound"], true);
  EXPECT_EQ(j["files"][1]["sound"], false);
  EXPECT_GE(j["files"][1]["failures"].size(), 2u);
}

TEST_F(Treedump, VerifyFindsBrokenInvariantsUnderRightChecksums) {
  std::vector<std::uint8_t> bytes = *encode_tree(sensitive());
  tampering::set(bytes, tampering::section_at(bytes, "LORD"), 0xffffu);
  const Outcome o = dump({save("forged.stree", bytes), "--verify"});
  EXPECT_EQ(o.status, 1);
  EXPECT_NE(o.out.find("LORD"), std::string::npos) << o.out;
}

TEST_F(Treedump, ADamagedSectionDoesNotHideTheOthers) {
  const std::string file = save("oak.stree", damaged(sensitive(), "LVTX"));
  const Outcome text = dump({file});
  EXPECT_EQ(text.status, 1);
  EXPECT_NE(text.out.find("14 radii"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("DAMAGED"), std::string::npos);
  EXPECT_EQ(line_count(text.err), 1u);
  const json j = json::parse(dump({file, "--json", "--arrays"}).out);
  EXPECT_EQ(j["sound"], false);
  EXPECT_TRUE(j["arrays"].contains("RADI"));
  EXPECT_FALSE(j["arrays"].contains("LVTX"));
}

TEST_F(Treedump, ADamagedHeaderStillShowsTheTableOfSections) {
  const std::string file = save("oak.stree", damaged(sensitive(), "HEAD"));
  const Outcome o = dump({file});
  EXPECT_EQ(o.status, 1);
  EXPECT_NE(o.out.find("TTRI"), std::string::npos) << o.out;
  EXPECT_EQ(dump({file, "--verify"}).status, 1);
}

TEST_F(Treedump, WhatIsNoContainerIsRefused) {
  write_text(folder_.path() / "oak.stree", "solid oak\n");
  for (const char* option : {"--json", "--verify", "--hierarchy"}) {
    const Outcome o = dump({folder_.file("oak.stree"), option});
    EXPECT_EQ(o.status, 1) << option;
    EXPECT_EQ(line_count(o.err), 1u) << o.err;
  }
  EXPECT_EQ(dump({folder_.file("none.stree")}).status, 3);
  EXPECT_EQ(dump({folder_.file("none.stree"), "--verify"}).status, 3);
}

TEST_F(Treedump, ExportsEveryFormatWithEveryTriangle) {
  const Tree tree = sensitive();
  const std::string file = save("oak.stree", tree);
  for (const char* name : {"oak.obj", "oak.ply", "oak.glb"}) {
    const Outcome o = dump({file, "--export", folder_.file(name)});
    EXPECT_EQ(o.status, 0) << o.err;
    EXPECT_EQ(o.out, "");
    const auto mesh = import_mesh(folder_.path() / name);
    ASSERT_TRUE(mesh) << name << ": " << mesh.error().what;
    // An importer may drop the degenerate triangles of random numbers.
    EXPECT_EQ(mesh->mesh.triangles.size() + mesh->counts.dropped_faces,
              tree.trunk.triangles.size() + tree.leaves.triangles.size())
        << name;
  }
}

TEST_F(Treedump, ATextureInTheFileIsToldWithItsSize) {
  Tree tree = sensitive();
  tree.textures[1] = {.uri = {}, .mime = "image/png", .bytes = std::vector<std::uint8_t>(1234, 7)};
  tree.materials[2].texture = 1;
  const std::string file = save("oak.stree", tree);
  EXPECT_NE(dump({file}).out.find("embedded image/png, 1.2"), std::string::npos) << dump({file}).out;
  bool found = false;
  const json all = json::parse(dump({file, "--json"}).out);
  for (const json& texture : all["textures"]) found |= texture["embedded_bytes"] == 1234;
  EXPECT_TRUE(found);
}

TEST_F(Treedump, TexturesAreFoundFromTheExportedFile) {
  Tree tree = sensitive();
  tree.textures[1] = {.uri = "tex/leaf 1.png", .mime = {}, .bytes = {}};
  tree.materials[2].texture = 1;
  std::filesystem::create_directories(folder_.path() / "out");
  EXPECT_EQ(dump({save("oak.stree", tree), "--export", folder_.file("out/oak.obj")}).status, 0);
  EXPECT_NE(read_text(folder_.path() / "out/oak.mtl").find("map_Kd ../tex/leaf 1.png\n"), std::string::npos)
      << read_text(folder_.path() / "out/oak.mtl");
}

TEST_F(Treedump, ALevelThatIsNotThereIsRefusedAndFullDetailIsLevelZero) {
  const std::string file = save("oak.stree", sensitive());
  const std::string out = folder_.file("oak.glb");
  for (const std::vector<std::string>& wish :
       {std::vector<std::string>{"--level", "1"}, {"--ratio", "0.5"}, {"--max-error", "0.1"}}) {
    const Outcome o = dump({file, "--export", out, wish[0], wish[1]});
    EXPECT_EQ(o.status, 1);
    EXPECT_NE(o.err.find("holds no levels of detail"), std::string::npos) << o.err;
    EXPECT_FALSE(std::filesystem::exists(out));
  }
  EXPECT_EQ(dump({file, "--export", out, "--level", "0"}).status, 0);
  EXPECT_EQ(dump({file, "--export", folder_.file("oak.stl")}).status, 2);
}

TEST_F(Treedump, DiffOfEqualContentsIsEmptyHoweverItIsStored) {
  const std::string a = save("a.stree", sensitive()),
                    b = save("b.stree", sensitive(), {.encoding = Encoding::zstd});
  const Outcome o = dump({a, b, "--diff"});
  EXPECT_EQ(o.status, 0) << o.out;
  EXPECT_NE(o.out.find("no differences"), std::string::npos);
  EXPECT_EQ(dump({a, b, "--diff", "-q"}).out, "");
}

TEST_F(Treedump, DiffNamesWhatDiffersAndByHowMuch) {
  Tree tree = sensitive();
  const std::string a = save("a.stree", tree);
  std::vector<Float2> texcoords = tree.leaves.texcoords.to_vector();
  texcoords[2].y += 0.25f;
  tree.leaves.texcoords = texcoords;
  tree.materials[1].shininess += 3;
  const std::string b = save("b.stree", tree);
  const Outcome o = dump({a, b, "--diff"});
  EXPECT_EQ(o.status, 1);
  EXPECT_NE(o.out.find("LTEX (leaf texture coordinates): 1 of "), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("y in 1 by up to 0.25"), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("material 1: shininess"), std::string::npos) << o.out;
  EXPECT_EQ(line_count(o.err), 1u);
  // Within a tolerance only what is larger counts.
  EXPECT_EQ(dump({a, b, "--diff", "--tolerance", "1"}).out.find("LTEX"), std::string::npos);
  EXPECT_EQ(dump({a, b, "--diff", "--tolerance", "5"}).status, 0);
}

TEST_F(Treedump, DiffOfDifferentKindsNamesWhatOnlyOneHas) {
  const Outcome o = dump({save("a.stree", sensitive()), save("b.tree", still()), "--diff"});
  EXPECT_EQ(o.status, 1);
  EXPECT_NE(o.out.find("kind: .stree, then .tree"), std::string::npos);
  EXPECT_NE(o.out.find("RADI (radii of the hierarchy): only in the first file"), std::string::npos);
  EXPECT_NE(o.out.find("TVTX (trunk vertices): only in the second file"), std::string::npos);
}

TEST_F(Treedump, AnswersGoIntoAFileWhenOneIsNamed) {
  const std::string file = save("oak.stree", sensitive()), out = folder_.file("oak.json");
  const Outcome o = dump({file, "--hierarchy", "-o", out});
  EXPECT_EQ(o.status, 0);
  EXPECT_EQ(o.out, "");
  EXPECT_EQ(json::parse(read_text(out))["radii"].size(), 14u);
}

TEST_F(Treedump, WrongUseIsOneLineAndStatusTwo) {
  const std::string file = save("oak.stree", sensitive());
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{},
                                                    {file, file},
                                                    {file, "--diff"},
                                                    {file, "--level", "1"},
                                                    {file, "--arrays"},
                                                    {file, "--json", "--hierarchy"},
                                                    {file, "--tolerance", "1"},
                                                    {file, file, "--diff", "--tolerance", "nan"},
                                                    {file, "--export", file + ".obj", "--level", "-1"},
                                                    {file, "--export", file + ".obj", "--draco"}}) {
    const Outcome o = dump(arguments);
    EXPECT_EQ(o.status, 2) << o.err;
    EXPECT_EQ(line_count(o.err), 1u) << o.err;
  }
}

}  // namespace
}  // namespace copse
