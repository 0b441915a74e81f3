// What ecogen packs into a file, and what it makes boxes of.
#include "lib/formats/import/image.h"
#include "lib/formats/levels/spectrum_file.h"
#include "lib/formats/tree_file/tree_file.h"
#include "lib/formats/tree_file/tree_volumes.h"
#include "tests/tools/ecogen_folder.h"
#include "tests/tools/rich_tree.h"

namespace copse {
namespace {

TEST_F(Ecogen, WhatIsPackedNeedsNoOtherFile) {
  ASSERT_EQ(run({"--pack", "--report", file("r.json")}).status, 0);
  const Ecosystem eco = load();
  EXPECT_TRUE(eco.types[0].uri.empty());
  const auto tree = TreeFile::from_bytes(eco.types[0].packed.to_vector(), "packed");
  ASSERT_TRUE(tree) << tree.error().what;
  EXPECT_EQ(tree->verify(), std::vector<std::string>{});
  EXPECT_FALSE(tree->has("PROV"));
  EXPECT_NE(read_text(file("r.json")).find("material 'gold'"), std::string::npos);  // nothing is made of it
}

// What a type's packed tree is.
TreeFile packed_tree(const Ecosystem& eco, std::size_t type) {
  auto tree = TreeFile::from_bytes(eco.types[type].packed.to_vector(), "packed");
  EXPECT_TRUE(tree) << tree.error().what;
  EXPECT_EQ(tree->verify(), std::vector<std::string>{});
  return *tree;
}

TEST_F(Ecogen, PackingLeavesOutLevelsThatNoFrameReaches) {
  write_rich_tree(folder_);
  // Full detail reaches 36 m.
  ASSERT_EQ(run_process({"lodbake", file("rich.stree"), "-o", file("rich.stree"), "--continuous",
                         "--discrete", "0.5,0.2", "--near", "40", "--far", "160"})
                .status,
            0);
  page_["types"] =
      Json::parse(R"([{"name": "rich", "tree": "rich.stree", "count": 5, "scale": {"min": 0.5, "max": 1}}])");
  const auto has_levels = [&](const char* range) {
    EXPECT_EQ(run({"--pack", "--view-range", range, "--report", file("r.json")}).status, 0);
    const bool has = has_spectra(packed_tree(load(), 0).container());
    EXPECT_EQ(read_text(file("r.json")).find("levels of detail") == std::string::npos, has);
    return has;
  };
  EXPECT_TRUE(has_levels("0"));   // no limit
  EXPECT_TRUE(has_levels("20"));  // at scale 1
  // At most 8 m at half the size, and what the tree reaches from its foot, by which its level goes.
  EXPECT_FALSE(has_levels("4"));
  const Ecosystem eco = load();
  EXPECT_EQ(eco.types[0].view_range, 4);
  // Its top is seen from 36 m when its foot is farther away.
  const double top = double{eco.types[0].bounds.max.y};
  ASSERT_GT(top, 1);
  EXPECT_TRUE(has_levels(std::to_string((36 - top + 0.1) * double{eco.types[0].scale_min}).c_str()));
}

TEST_F(Ecogen, PackingLeavesOutThePictureBehindLevelsThatNoFrameReaches) {
  write_rich_tree(folder_);
  ASSERT_EQ(run_process({"lodbake", file("rich.stree"), "-o", file("rich.stree"), "--discrete", "0.5",
                         "--far", "40", "--impostor", "32", "--impostor-views", "2"})
                .status,
            0);
  page_["types"] = Json::parse(R"([{"name": "rich", "tree": "rich.stree", "count": 5}])");
  for (const bool shown : {true, false}) {
    ASSERT_EQ(run({"--pack", "--view-range", shown ? "100" : "1", "--report", file("r.json")}).status, 0);
    const TreeFile tree = packed_tree(load(), 0);
    for (const char* name : {"LSLD", "IMPO", "IMPA", "IMPN"}) EXPECT_EQ(tree.has(name), shown) << name;
    EXPECT_EQ(read_text(file("r.json")).find("picture from afar") == std::string::npos, shown);
  }
}

TEST_F(Ecogen, PackingLeavesOutVolumesThatNothingIsTestedWith) {
  write_rich_tree(folder_);
  page_["types"] = Json::parse(R"([{"name": "rich", "tree": "rich.stree", "count": 5}])");
  const auto whole = TreeFile::open(file("rich.stree"));
  ASSERT_TRUE(whole);
  const auto all = load_volumes(*whole);
  ASSERT_TRUE(all);
  ASSERT_EQ(run({"--pack"}).status, 0);
  const auto still = load_volumes(packed_tree(load(), 0));
  ASSERT_TRUE(still) << still.error().what;
  EXPECT_EQ(still->sets.size(), all->sets.size() / 2);  // no envelopes
  EXPECT_EQ(still->volumes.size(), still->sets.size());
  EXPECT_EQ(still->chosen(still->sets[0]), all->chosen(all->sets[0]));
  page_["types"][0]["motion"] = 2;
  const Outcome o = run({"--pack"});
  ASSERT_EQ(o.status, 0);
  EXPECT_EQ(o.err.find("envelope"), std::string::npos);
  const auto moving = load_volumes(packed_tree(load(), 0));
  ASSERT_TRUE(moving);
  EXPECT_EQ(moving->sets.size(), all->sets.size());
}

TEST_F(Ecogen, BoxesAreThoseOfTheTreesVolumesAndOfTheirMotion) {
  const auto volume_of_boxes = [&] {
    double sum = 0;
    const Ecosystem eco = load();
    for (const InstanceBlock& b : eco.blocks) {
      const Float3 e = b.bounds.extent();
      sum += double{e.x} * double{e.y} * double{e.z};
    }
    return sum;
  };
  write_rich_tree(folder_);
  ASSERT_EQ(run_process({"treeprep", file("rich.obj"), "-o", file("none.stree")}).status, 0);
  page_["hierarchy_depth"] = 6;
  page_["types"] = Json::parse(
      R"([{"name": "rich", "tree": "none.stree", "count": 200, "scale": 0.1, "tilt": {"pitch": 20, "roll": 20}}])");
  ASSERT_EQ(run().status, 0);
  const double boxes = volume_of_boxes();
  page_["types"][0]["tree"] = "rich.stree";
  ASSERT_EQ(run().status, 0);
  const double volumes = volume_of_boxes();
  EXPECT_LT(volumes, 0.9 * boxes);
  page_["types"][0]["motion"] = 1;
  ASSERT_EQ(run().status, 0);
  EXPECT_GT(volume_of_boxes(), volumes);
  page_["types"][0]["tree"] = "none.stree";
  const Outcome o = run();
  ASSERT_EQ(o.status, 0);
  EXPECT_NE(o.err.find("has no envelope of its motion"), std::string::npos) << o.err;
}

TEST_F(Ecogen, PackingCopiesInTheTexturesThatAreShownAndNoOthers) {
  std::string obj = little_tree_obj(6, 5, 4);
  obj.replace(obj.find("none.mtl"), 8, "t.mtl");
  write_text(file("t.obj"), obj);
  write_text(file("t.mtl"), "newmtl bark\nmap_Kd bark.png\nnewmtl leaf\nmap_Kd leaf.png\n");
  const Image image{.width = 2, .height = 1, .rgba = {255, 0, 0, 255, 0, 255, 0, 255}, .has_alpha = false};
  for (const char* name : {"bark.png", "leaf.png"}) ASSERT_TRUE(write_image(file(name), image));
  ASSERT_EQ(run_process({"treeprep", file("t.obj"), "-o", file("t.stree")}).status, 0);
  page_["types"] = Json::parse(R"([{"name": "t", "tree": "t.stree", "count": 5, "trunk_material": "gold"}])");
  ASSERT_EQ(run({"--pack", "--report", file("r.json"), "--depfile", file("d")}).status, 0);
  const auto tree = packed_tree(load(), 0).load();
  ASSERT_TRUE(tree);
  ASSERT_EQ(tree->textures.size(), 1u);  // every trunk is of gold
  EXPECT_TRUE(tree->textures[0].uri.empty());
  const std::string png = read_text(file("leaf.png"));
  EXPECT_EQ(tree->textures[0].bytes, (std::vector<std::uint8_t>{png.begin(), png.end()}));
  EXPECT_NE(read_text(file("r.json")).find("bark.png"), std::string::npos);
  EXPECT_NE(read_text(file("d")).find("leaf.png"), std::string::npos);
  page_["types"][0]["leaf_material"] = "gold";
  ASSERT_EQ(run({"--pack"}).status, 0);
  EXPECT_TRUE(packed_tree(load(), 0).load()->textures.empty());
}

}  // namespace
}  // namespace copse
