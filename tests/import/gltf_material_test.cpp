#include "tests/import/gltf_maker.h"

#include <cmath>
#include <numbers>

namespace copse {
namespace {

using namespace copse::testing;

Import with(GltfMaker& maker, const Json& material) {
  const Json attributes = {{"POSITION", maker.triangle()},
                           {"TEXCOORD_0", maker.accessor<float>({0, 0, 1, 0, 0, 1}, "VEC2")},
                           {"TEXCOORD_1", maker.accessor<float>({0.5, 0.5, 0.75, 0.5, 0.5, 0.75}, "VEC2")}};
  maker.add("materials", material);
  maker.show({{"attributes", attributes}, {"material", 0}});
  return maker.import();
}

Material material(const Json& json) {
  GltfMaker maker;
  const Import m = with(maker, json);
  EXPECT_EQ(m.mesh.parts[0].material, 0u);
  return m.mesh.materials.at(0);
}

void expect_colour(const Float3& a, double x, double y, double z) {
  EXPECT_NEAR(a.x, x, 1e-6);
  EXPECT_NEAR(a.y, y, 1e-6);
  EXPECT_NEAR(a.z, z, 1e-6);
}

TEST(GltfMaterial, ARoughDielectricIsDiffuse) {
  const Material m = material(
      {{"name", "bark"},
       {"doubleSided", true},
       {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 0.125, 1}}, {"metallicFactor", 0}}}});
  EXPECT_EQ(m.name, "bark");
  EXPECT_TRUE(m.double_sided);
  expect_colour(m.diffuse, 0.5, 0.25, 0.125);
  expect_colour(m.ambient, 0.5, 0.25, 0.125);
  expect_colour(m.specular, 0, 0, 0);
  EXPECT_EQ(m.shininess, 0);
  EXPECT_EQ(m.alpha, 1);
  EXPECT_EQ(m.alpha_cutoff, 0);
}

TEST(GltfMaterial, ASmootherDielectricShines) {
  const Material m = material({{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 0.5}}}});
  expect_colour(m.diffuse, 1, 1, 1);
  expect_colour(m.specular, 0.04 * 0.75, 0.04 * 0.75, 0.04 * 0.75);
  EXPECT_NEAR(m.shininess, 30, 1e-4);  // 2 / 0.25^2 - 2
}

TEST(GltfMaterial, AMetalReflectsItsColour) {
  const Material m =
      material({{"pbrMetallicRoughness", {{"baseColorFactor", {1, 0.5, 0, 1}}, {"roughnessFactor", 0}}}});
  expect_colour(m.diffuse, 0, 0, 0);
  expect_colour(m.specular, 1, 0.5, 0);
  EXPECT_EQ(m.shininess, 1000);
}

TEST(GltfMaterial, TheDefaultMetalOfCarelessExportersIsDiffuse) {
  expect_colour(material({{"pbrMetallicRoughness", {{"baseColorFactor", {1, 0.5, 0.25, 1}}}}}).diffuse, 1,
                0.5, 0.25);
}

TEST(GltfMaterial, EmissionIorSpecularAndUnlit) {
  const Material m = material(
      {{"emissiveFactor", {1, 0.5, 0}},
       {"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 0.5}}},
       {"extensions",
        {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}},
         {"KHR_materials_ior", {{"ior", 2}}},
         {"KHR_materials_specular", {{"specularFactor", 0.5}, {"specularColorFactor", {1, 0, 0}}}}}}});
  expect_colour(m.emission, 4, 2, 0);
  expect_colour(m.specular, 0.5 / 9 * 0.75, 0, 0);
  const Material unlit =
      material({{"pbrMetallicRoughness",
                 {{"baseColorFactor", {1, 0, 0, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 0}}},
                {"extensions", {{"KHR_materials_unlit", Json::object()}}}});
  expect_colour(unlit.diffuse, 1, 0, 0);
  expect_colour(unlit.specular, 0, 0, 0);
  EXPECT_EQ(unlit.shininess, 0);
}

TEST(GltfMaterial, SpecularGlossiness) {
  const Material m = material({{"extensions",
                                {{"KHR_materials_pbrSpecularGlossiness",
                                  {{"diffuseFactor", {0.5, 0.25, 0, 1}},
                                   {"specularFactor", {0.2, 0.4, 0.6}},
                                   {"glossinessFactor", 0.5}}}}}});
  expect_colour(m.diffuse, 0.5, 0.25, 0);
  expect_colour(m.specular, 0.15, 0.3, 0.45);
  EXPECT_NEAR(m.shininess, 30, 1e-4);
}

TEST(GltfMaterial, AlphaModes) {
  const Json half = {{"baseColorFactor", {1, 1, 1, 0.5}}};
  EXPECT_EQ(material({{"pbrMetallicRoughness", half}}).alpha, 1) << "opaque: alpha is ignored";
  EXPECT_EQ(material({{"alphaMode", "MASK"}}).alpha_cutoff, 0.5f);
  EXPECT_EQ(material({{"alphaMode", "MASK"}, {"alphaCutoff", 0.2}}).alpha_cutoff, 0.2f);
  const Material glass = material({{"alphaMode", "BLEND"}, {"pbrMetallicRoughness", half}});
  EXPECT_EQ(glass.alpha, 0.5f);
  EXPECT_EQ(glass.alpha_cutoff, 0);
}

TEST(GltfMaterial, ABlendedTextureIsCutOut) {
  GltfMaker maker;
  maker.add("images", {{"uri", "maps/my%20leaf.png"}, {"mimeType", "image/png"}});
  maker.add("textures", {{"source", 0}});
  const Import m =
      with(maker, {{"alphaMode", "BLEND"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  EXPECT_EQ(m.mesh.materials[0].alpha_cutoff, 0.5f);
  ASSERT_EQ(m.mesh.textures.size(), 1u);
  EXPECT_EQ(m.mesh.textures[0].uri, "maps/my leaf.png");
  EXPECT_EQ(m.mesh.textures[0].mime, "image/png");
}

TEST(GltfMaterial, ImagesMayBeEmbeddedInABufferOrInTheText) {
  const std::string png = "\x89PNG not really";
  GltfMaker maker;
  maker.add("images", {{"bufferView", maker.view(std::vector<char>(png.begin(), png.end()))},
                       {"mimeType", "image/png"}});
  maker.add("images", {{"uri", "data:image/png;base64," + base64(png)}});
  maker.add("textures", {{"source", 0}});
  maker.add("textures", {{"extensions", {{"EXT_texture_webp", {{"source", 1}}}}}});
  maker.add("textures", {{"source", 0}});
  for (const int i : {1, 2})
    maker.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", i}}}}}});
  const Import m = with(maker, {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  ASSERT_EQ(m.mesh.textures.size(), 2u) << "one a used image";
  for (const Texture& texture : m.mesh.textures) {
    EXPECT_EQ(std::string(texture.bytes.begin(), texture.bytes.end()), png);
    EXPECT_EQ(texture.mime, "image/png");
    EXPECT_TRUE(texture.uri.empty());
  }
  EXPECT_EQ(m.mesh.materials[0].texture, 0u);
  EXPECT_EQ(m.mesh.materials[1].texture, 1u);
  EXPECT_EQ(m.mesh.materials[2].texture, 1u);
}

TEST(GltfMaterial, OverlappingImagesCannotBeMultiplied) {
  GltfMaker maker;
  const int view = maker.view(std::vector<char>(20'000, 'x'));
  for (int i = 0; i < 20; ++i) {
    maker.add("images", {{"bufferView", view}});
    maker.add("textures", {{"source", i}});
    maker.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", i}}}}}});
  }
  EXPECT_NE(maker.refusal().find("its images overlap"), std::string::npos);
}

TEST(GltfMaterial, TexturesThatCannotBeReadAreLeftOutWithAWarning) {
  GltfMaker maker;
  maker.add("images", {{"uri", "../leaf.png"}});
  maker.add("textures", {{"source", 0}});
  maker.add("textures", {{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}});
  maker.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 1}}}}}});
  const Import m = with(maker, {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  EXPECT_TRUE(m.mesh.textures.empty());
  EXPECT_EQ(m.mesh.materials[0].texture, k_none);
  EXPECT_EQ(m.warnings.size(), 2u);
}

TEST(GltfMaterial, ATextureMayUseTheSecondSetOfCoordinates) {
  GltfMaker maker;
  maker.add("images", {{"uri", "leaf.png"}});
  maker.add("textures", {{"source", 0}});
  const Import m =
      with(maker, {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", 1}}}}}});
  EXPECT_EQ(m.mesh.texcoords, (std::vector<Float2>{{0.5f, 0.5f}, {0.75f, 0.5f}, {0.5f, 0.25f}}));
}

TEST(GltfMaterial, TextureTransformsAreAppliedToTheCoordinates) {
  GltfMaker maker;
  maker.add("images", {{"uri", "leaf.png"}});
  maker.add("textures", {{"source", 0}});
  // The first example of the extension: the lower left quadrant, turned clockwise by 90 degrees.
  const Json transform = {{"offset", {0, 1}}, {"rotation", std::numbers::pi / 2}, {"scale", {0.5, 0.5}}};
  const Import m = with(
      maker,
      {{"pbrMetallicRoughness",
        {{"baseColorTexture", {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}}}}}});
  // In glTF's frame (0, 0) (1, 0) (0, 1) become (0, 1) (0, 0.5) (0.5, 1): all in u <= 0.5, v >= 0.5.
  ASSERT_EQ(m.mesh.texcoords.size(), 3u);
  const std::vector<Float2> expected{{0, 0}, {0, 0.5f}, {0.5f, 0}};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(m.mesh.texcoords[i].x, expected[i].x, 1e-6);
    EXPECT_NEAR(m.mesh.texcoords[i].y, expected[i].y, 1e-6);
  }
}

TEST(GltfMaterial, TwoMaterialsWithDifferentTransformsDoNotShareCoordinates) {
  GltfMaker maker;
  maker.add("images", {{"uri", "leaf.png"}});
  maker.add("textures", {{"source", 0}});
  const Json transform = {{"offset", {0.5, 0}}};
  const Import first = with(maker, {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  maker.add(
      "materials",
      {{"pbrMetallicRoughness",
        {{"baseColorTexture", {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}}}}}});
  Json second = maker.json["meshes"][0]["primitives"][0];
  second["material"] = 1;
  maker.json["meshes"][0]["primitives"].push_back(second);
  const Import m = maker.import();
  EXPECT_EQ(m.mesh.positions.size(), 3u);
  EXPECT_EQ(m.mesh.texcoords.size(), 6u);
  EXPECT_EQ(m.mesh.texcoords[3].x, 0.5f);
}

}  // namespace
}  // namespace copse
