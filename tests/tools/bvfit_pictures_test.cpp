// bvfit's pictures and its GLB: with the textures of the input, and what their alpha cuts out.
#include "lib/formats/import/image.h"
#include "lib/formats/import/import.h"
#include "tests/tools/process.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace copse {
namespace {

// A card with a texture beside it, whose right half is cut out.
class BvfitPictures : public testing::Test {
 protected:
  void SetUp() override {
    write_text(folder_.path() / "card.obj",
               "mtllib card.mtl\nv 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
               "usemtl leaf\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n");
    write_text(folder_.path() / "card.mtl", "newmtl leaf\nmap_Kd leaf.png\nmap_d leaf.png\n");
  }
  void texture(bool has_hole) const {
    Image image{8, 8, std::vector<std::uint8_t>(8 * 8 * 4, 255), true};
    for (std::size_t i = 0; has_hole && i < 64; ++i) image.rgba[4 * i + 3] = i % 8 < 4 ? 255 : 0;
    ASSERT_TRUE(write_image(folder_.path() / "leaf.png", image));
  }
  std::string page() const {
    const Outcome o = run_process(
        {"bvfit", folder_.file("card.obj"), "--volumes", "obb", "-q", "--html", folder_.file("card.html")});
    EXPECT_EQ(o.status, 0) << o.err;
    const std::string html = read_text(folder_.path() / "card.html");
    const std::size_t from = html.find("data:image/png;base64,");
    return html.substr(from, html.find('"', from) - from);
  }
  TemporaryFolder folder_;
};

TEST_F(BvfitPictures, WhatTheAlphaOfATextureCutsOutIsNotDrawn) {
  texture(false);
  const std::string whole = page();
  texture(true);
  EXPECT_NE(page(), whole);
  texture(false);
  EXPECT_EQ(page(), whole);
}

TEST_F(BvfitPictures, ATextureThatIsMissingIsWarnedAboutAndCountsAsOpaque) {
  const Outcome o = run_process({"bvfit", folder_.file("card.obj"), "--html", folder_.file("card.html"),
                                 "--export-glb", folder_.file("card.glb")});
  EXPECT_EQ(o.status, 0) << o.err;
  EXPECT_NE(o.err.find("leaf.png"), std::string::npos) << o.err;
  EXPECT_NE(o.err.find("counts as opaque"), std::string::npos) << o.err;
  EXPECT_NE(o.err.find("left out"), std::string::npos) << o.err;
}

TEST_F(BvfitPictures, TheGlbCarriesTheTexturesOfTheMesh) {
  texture(true);
  ASSERT_EQ(
      run_process({"bvfit", folder_.file("card.obj"), "-q", "--export-glb", folder_.file("card.glb")}).status,
      0);
  const auto glb = import_mesh(folder_.path() / "card.glb");
  ASSERT_TRUE(glb) << glb.error().what;
  ASSERT_EQ(glb->mesh.textures.size(), 1u);
  const auto image = read_image(glb->mesh.textures[0].bytes, "embedded");
  ASSERT_TRUE(image);
  EXPECT_EQ(image->rgba[4 * 7 + 3], 0);
  std::size_t textured = 0;
  for (const Material& m : glb->mesh.materials) textured += m.texture != k_none;
  EXPECT_EQ(textured, 1u);
}

TEST_F(BvfitPictures, AListBeforeTheInputDoesNotSwallowIt) {
  texture(false);
  const Outcome o = run_process({"bvfit", "--volumes", "obb,sphere", "--methods", "minimal", "--per", "whole",
                                 folder_.file("card.obj")});
  EXPECT_EQ(o.status, 0) << o.err;
}

TEST_F(BvfitPictures, TheHeadlineIsOfTheVolumeThatIsChosen) {
  texture(false);
  const std::string report = folder_.file("card.json");
  ASSERT_EQ(run_process({"bvfit", folder_.file("card.obj"), "-q", "--choose", "weighted", "--volumes",
                         "aabb,sphere", "--report", report})
                .status,
            0);
  const auto j = nlohmann::json::parse(read_text(report));
  const Outcome o = run_process({"bvfit", folder_.file("card.obj"), "--choose", "weighted", "--volumes",
                                 "aabb,sphere", "-q", "-o", folder_.file("v.json")});
  ASSERT_EQ(o.status, 0) << o.err;
  const auto set = nlohmann::json::parse(read_text(folder_.path() / "v.json"))["sets"][0];
  const std::string chosen = set["volumes"][set["chosen"].get<std::size_t>()]["type"];
  EXPECT_EQ(j["errors"][0]["name"].get<std::string>().substr(0, chosen.size()), chosen);
}

}  // namespace
}  // namespace copse
