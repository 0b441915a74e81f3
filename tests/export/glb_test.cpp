#include "lib/formats/export/export.h"
#include "tests/export/glb_file.h"
#include "tests/export/meshes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace copse {
namespace {

GlbFile glb_of(const Mesh& mesh, const ExportOptions& options = {}) {
  const auto files = export_mesh(mesh, ExportFormat::glb, "a.glb", options);
  EXPECT_TRUE(files) << files.error().what;
  return take_apart(files->front().bytes);
}

TEST(Glb, KeepsObjectsGroupsAndMaterialsApart) {
  const auto json = glb_of(small_mesh()).json;
  ASSERT_EQ(json["nodes"].size(), 2u);
  EXPECT_EQ(json["nodes"][0]["name"], "trunk");
  EXPECT_EQ(json["nodes"][1]["name"], "crown");
  EXPECT_EQ(json["meshes"][0]["name"], "wood");
  EXPECT_EQ(json["meshes"][0]["primitives"].size(), 1u);
  EXPECT_EQ(json["meshes"][1]["primitives"].size(), 2u);
  EXPECT_EQ(json["scenes"][0]["nodes"].size(), 2u);
}

TEST(Glb, MakesOneVertexOfCornersThatAgreeInEverything) {
  const GlbFile file = glb_of(small_mesh());
  const auto& square = file.json["meshes"][0]["primitives"][0];
  EXPECT_EQ(file.json["accessors"][square["attributes"]["POSITION"].get<std::size_t>()]["count"], 4);
  EXPECT_EQ(file.indices(square["indices"]), (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(file.json["accessors"][square["indices"].get<std::size_t>()]["componentType"], 5123);
}

TEST(Glb, BoundsAreExactlyThoseOfTheStoredPositions) {
  const GlbFile file = glb_of(small_mesh());
  for (const auto& mesh : file.json["meshes"]) {
    for (const auto& primitive : mesh["primitives"]) {
      const std::size_t index = primitive["attributes"]["POSITION"];
      const std::vector<float> values = file.floats(index);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        float low = values[axis], high = values[axis];
        for (std::size_t i = axis; i < values.size(); i += 3) {
          low = std::min(low, values[i]);
          high = std::max(high, values[i]);
        }
        EXPECT_EQ(file.json["accessors"][index]["min"][axis].get<double>(), static_cast<double>(low));
        EXPECT_EQ(file.json["accessors"][index]["max"][axis].get<double>(), static_cast<double>(high));
      }
    }
  }
}

TEST(Glb, NormalsAreUnitVectorsAndMissingOnesAreTheTrianglesOwn) {
  const GlbFile file = glb_of(small_mesh());
  const auto& leaf = file.json["meshes"][1]["primitives"][0];
  const std::vector<float> normals = file.floats(leaf["attributes"]["NORMAL"]);
  ASSERT_EQ(normals.size(), 9u);
  for (std::size_t i = 0; i < 9; i += 3) {
    EXPECT_NEAR(std::hypot(normals[i], normals[i + 1], normals[i + 2]), 1, 1e-6);
  }
  EXPECT_EQ(normals[2], 1);           // given as (0, 0, 2)
  EXPECT_NE(normals[3 + 2], 1);       // not given
  EXPECT_EQ(normals[3], normals[6]);  // given as (0, 0, 0), which is no direction
  // A primitive of which no corner has a normal has none.
  EXPECT_FALSE(file.json["meshes"][1]["primitives"][1]["attributes"].contains("NORMAL"));
}

TEST(Glb, TextureSpaceBeginsAtTheUpperLeft) {
  const GlbFile file = glb_of(small_mesh());
  const auto& square = file.json["meshes"][0]["primitives"][0];
  const std::vector<float> uv = file.floats(square["attributes"]["TEXCOORD_0"]);
  EXPECT_EQ(uv, (std::vector<float>{0, 1, 1, 1, 1, 0.75f, 0, 0}));
}

TEST(Glb, MaterialsBecomeMetallicRoughness) {
  const auto json = glb_of(small_mesh()).json;
  const auto& bark = json["materials"][0];
  EXPECT_EQ(bark["pbrMetallicRoughness"]["baseColorFactor"], (std::vector<double>{0.25, 0.2, 0.1, 1}));
  EXPECT_EQ(bark["pbrMetallicRoughness"]["roughnessFactor"], 1.0);
  EXPECT_FALSE(bark.contains("alphaMode"));
  const auto& leaf = json["materials"][1];
  EXPECT_EQ(leaf["name"], "leaf <1>");
  EXPECT_EQ(leaf["alphaMode"], "MASK");
  EXPECT_EQ(leaf["alphaCutoff"], 0.4);
  EXPECT_EQ(leaf["doubleSided"], true);
  EXPECT_NEAR(leaf["pbrMetallicRoughness"]["roughnessFactor"].get<double>(), 0.5, 1e-9);  // (2 / 32)^(1/4)
  EXPECT_EQ(leaf["emissiveFactor"], (std::vector<double>{1, 0.5, 0}));
  EXPECT_EQ(leaf["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"], 4);
}

TEST(Glb, APrimitiveWithoutTextureCoordinatesGetsAMaterialWithoutTexture) {
  const auto json = glb_of(small_mesh()).json;
  const auto& plain = json["meshes"][1]["primitives"][1];
  ASSERT_FALSE(plain["attributes"].contains("TEXCOORD_0"));
  const auto& material = json["materials"][plain["material"].get<std::size_t>()];
  EXPECT_EQ(material["name"], "bark");
  EXPECT_FALSE(material["pbrMetallicRoughness"].contains("baseColorTexture"));
}

TEST(Glb, EmbedsEmbeddedTexturesAndRefersToTheOthers) {
  const GlbFile file = glb_of(small_mesh());
  EXPECT_EQ(file.json["images"][0]["uri"], "tex/bark%201.png");
  const auto& embedded = file.json["images"][1];
  EXPECT_EQ(embedded["mimeType"], "image/png");
  const auto& view = file.json["bufferViews"][embedded["bufferView"].get<std::size_t>()];
  const std::vector<std::uint8_t> png = png_bytes();
  EXPECT_EQ(file.binary.substr(view["byteOffset"], view["byteLength"]), std::string(png.begin(), png.end()));
}

TEST(Glb, AnImageThatIsNeitherPngNorJpegGoesBesideTheFile) {
  Mesh mesh = small_mesh();
  mesh.textures[1].bytes = {'D', 'D', 'S', ' ', 1, 2, 3};
  const auto files = export_mesh(mesh, ExportFormat::glb, "oak.glb");
  ASSERT_TRUE(files);
  ASSERT_EQ(files->size(), 2u);
  EXPECT_EQ((*files)[1].name, "oak_texture1.dds");
  EXPECT_EQ(take_apart((*files)[0].bytes).json["images"][1]["uri"], "oak_texture1.dds");
}

TEST(Glb, AMeshFarFromTheOriginKeepsItsShape) {
  Mesh mesh = small_mesh();
  for (Double3& p : mesh.positions) p += {1e7, 0, -3e6};
  const GlbFile file = glb_of(mesh);
  const auto& origin = file.json["nodes"].back();
  ASSERT_TRUE(origin.contains("translation"));
  EXPECT_EQ(origin["children"], (std::vector<int>{0, 1}));
  EXPECT_EQ(file.json["scenes"][0]["nodes"], std::vector<int>{2});
  const std::vector<float> stored =
      file.floats(file.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"]);
  for (std::size_t v = 0; v < 4; ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double back =
          origin["translation"][axis].get<double>() + static_cast<double>(stored[3 * v + axis]);
      EXPECT_NEAR(back, mesh.positions[v][static_cast<int>(axis)], 1e-7 * 3);
    }
  }
}

TEST(Glb, AnEmptyMeshIsAValidFileWithNothingInIt) {
  const auto json = glb_of(Mesh{}).json;
  EXPECT_EQ(json["scenes"], nlohmann::json::parse("[{}]"));
  for (const char* absent : {"nodes", "meshes", "accessors", "buffers", "bufferViews", "materials"}) {
    EXPECT_FALSE(json.contains(absent)) << absent;
  }
}

TEST(Glb, RefusesCoordinatesThatFloatCannotHold) {
  Mesh mesh = small_mesh();
  mesh.positions[0] = {1e39, 0, 0};
  mesh.positions[1] = {-1e39, 0, 0};
  const auto files = export_mesh(mesh, ExportFormat::glb, "a.glb");
  ASSERT_FALSE(files);
  EXPECT_EQ(files.error().fault, Fault::refused);
}

TEST(Glb, NamesThatAreNotUtf8DoNotBreakTheFile) {
  Mesh mesh = small_mesh();
  mesh.parts[0].object = "\xff\xfe tree";
  EXPECT_NE(glb_of(mesh).json["nodes"][0]["name"].get<std::string>().find("tree"), std::string::npos);
}

TEST(Glb, WideIndicesComeWithMoreThan65535Vertices) {
  Mesh mesh;
  mesh.parts = {Part{}};
  for (std::uint32_t i = 0; i < 65538; ++i) {
    mesh.positions.push_back({static_cast<double>(i), static_cast<double>(i % 7), 0});
    if (i % 3 == 2) mesh.triangles.push_back({i - 2, i - 1, i});
  }
  mesh.part_of.assign(mesh.triangles.size(), 0);
  const GlbFile file = glb_of(mesh);
  EXPECT_EQ(file.json["accessors"][0]["componentType"], 5125);
  EXPECT_EQ(file.indices(0).back(), 65537u);
}

TEST(Glb, DracoStreamsAreDeclaredWithWhatADecoderFinds) {
  const GlbFile file = glb_of(small_mesh(), {.draco = true, .draco_position_bits = 20});
  EXPECT_EQ(file.json["extensionsRequired"], std::vector<std::string>{"KHR_draco_mesh_compression"});
  const auto& primitive = file.json["meshes"][0]["primitives"][0];
  const auto& draco = primitive["extensions"]["KHR_draco_mesh_compression"];
  const auto& view = file.json["bufferViews"][draco["bufferView"].get<std::size_t>()];
  EXPECT_EQ(file.binary.substr(view["byteOffset"], 5), "DRACO");
  const auto& position = file.json["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
  EXPECT_FALSE(position.contains("bufferView"));
  EXPECT_EQ(position["count"], 4);
  EXPECT_NEAR(position["max"][0].get<double>(), 1, 1e-5);
  EXPECT_EQ(file.json["accessors"][primitive["indices"].get<std::size_t>()]["count"], 6);
}

TEST(Export, RefusesIndicesOutOfRangeNamingThem) {
  for (const ExportFormat format : {ExportFormat::obj, ExportFormat::ply, ExportFormat::glb}) {
    Mesh mesh = small_mesh();
    mesh.triangles[3][1] = 99;
    const auto files = export_mesh(mesh, format, "a");
    ASSERT_FALSE(files);
    EXPECT_NE(files.error().what.find("triangle 3 names vertex 99 of 7"), std::string::npos);
  }
  Mesh mesh = small_mesh();
  mesh.part_of.pop_back();
  EXPECT_FALSE(export_mesh(mesh, ExportFormat::obj, "a"));
  mesh = small_mesh();
  mesh.materials[0].texture = 7;
  EXPECT_FALSE(export_mesh(mesh, ExportFormat::glb, "a"));
}

TEST(Export, TheExtensionPicksTheFormat) {
  EXPECT_EQ(export_format_of("x/a.GLB"), ExportFormat::glb);
  EXPECT_EQ(export_format_of("a.obj"), ExportFormat::obj);
  const auto none = export_format_of("a.stl");
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().fault, Fault::usage);
}

TEST(Export, TheSameMeshGivesTheSameBytes) {
  for (const ExportFormat format : {ExportFormat::obj, ExportFormat::ply, ExportFormat::glb}) {
    EXPECT_EQ(export_mesh(small_mesh(), format, "a")->front().bytes,
              export_mesh(small_mesh(), format, "a")->front().bytes);
  }
}

}  // namespace
}  // namespace copse
