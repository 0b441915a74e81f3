// The container and the JSON of glTF, well-formed and not.
#include "tests/import/gltf_maker.h"

namespace copse {
namespace {

using namespace copse::testing;

GltfMaker simple() {
  GltfMaker maker;
  maker.show({{"attributes", {{"POSITION", maker.triangle()}}}});
  return maker;
}

std::string refusal(const std::string& bytes) {
  const std::string line = error_of(read(bytes, MeshFormat::unknown));
  const std::string head = "import: error: tree: ";
  return line.starts_with(head) ? line.substr(head.size(), line.find(';') - head.size()) : line;
}

std::string with_u32(std::string bytes, std::size_t at, std::uint32_t value) {
  std::memcpy(bytes.data() + at, &value, 4);
  return bytes;
}

TEST(GltfFile, EveryTruncationIsRefused) {
  const std::string file = simple().glb();
  for (std::size_t size = 4; size < file.size(); ++size)
    EXPECT_FALSE(read(file.substr(0, size), MeshFormat::glb)) << size;
  EXPECT_EQ(refusal(file.substr(0, 19)), "ends in the middle of its header");
  EXPECT_EQ(refusal(file.substr(0, 100)),
            "has 100 bytes, and its header says " + std::to_string(file.size()));
}

TEST(GltfFile, DamagedContainersAreRefused) {
  const std::string file = simple().glb();
  EXPECT_EQ(refusal(with_u32(file, 4, 1)), "is GLB version 1, and only version 2 is read");
  EXPECT_EQ(refusal(with_u32(file, 12, 0xfffffff0u)),
            "byte 12: a chunk of 4294967280 bytes reaches beyond the end");
  EXPECT_EQ(refusal(with_u32(file, 16, 7)), "has no JSON chunk");
  EXPECT_EQ(refusal(with_u32(file, 8, 21)),
            "byte 12: a chunk of " + std::to_string(file[12] + 256 * file[13] + (file[12] < 0 ? 256 : 0)) +
                " bytes reaches beyond the end");
}

TEST(GltfFile, ChunksOfOtherTypesAndTrailingBytesAreSkipped) {
  std::string file = simple().glb();
  std::string extra = file + std::string("\4\0\0\0XYZ\0data", 12);
  extra = with_u32(extra, 8, static_cast<std::uint32_t>(extra.size()));
  EXPECT_EQ(good(read(extra, MeshFormat::glb)).mesh.triangles.size(), 1u);
  EXPECT_EQ(good(read(file + "tail", MeshFormat::glb)).warnings,
            (std::vector<std::string>{"byte " + std::to_string(file.size()) +
                                      ": bytes follow the end of the GLB (bytes after the end: 1)"}));
}

TEST(GltfFile, DamagedJsonIsRefusedWithItsByte) {
  EXPECT_EQ(refusal("{\"asset\": }"), "byte 11 of its JSON is wrong");
  EXPECT_EQ(refusal("{\"asset\": \"\xff\"}"), "byte 12 of its JSON is wrong");
  EXPECT_EQ(error_of(read("[1]", MeshFormat::gltf)),
            "import: error: tree: its JSON is no object; export the mesh again, or check it with the glTF "
            "validator");
}

TEST(GltfFile, JsonThatNestsTooDeepIsRefusedBeforeItIsParsed) {
  const std::string deep = "{\"extras\":" + std::string(1'000'000, '[') + std::string(1'000'000, ']') + "}";
  EXPECT_EQ(refusal(deep), "its JSON nests deeper than 128 levels");
  EXPECT_EQ(refusal("{\"extras\":" + std::string(1'000'000, '[')), "its JSON nests deeper than 128 levels");
  EXPECT_TRUE(read("{\"asset\":{\"version\":\"2.0\"},\"extras\":\"" + std::string(500, '[') + "\"}",
                   MeshFormat::gltf))
      << "brackets in a text";
}

TEST(GltfFile, OtherVersionsAreRefused) {
  EXPECT_EQ(refusal("{\"asset\":{\"version\":\"1.0\"}}"), "is glTF '1.0', and only glTF 2 is read");
  EXPECT_EQ(refusal("{\"asset\":{\"version\":\"2.0\",\"minVersion\":\"2.1\"}}"),
            "needs glTF '2.1', and only 2.0 is read");
  EXPECT_EQ(refusal("{\"meshes\":{}}"), "is glTF '1.0', and only glTF 2 is read");
  EXPECT_EQ(good(read("{\"meshes\":[]}", MeshFormat::gltf)).warnings,
            (std::vector<std::string>{"asset.version is missing, taken as 2.0 (missing properties: 1)"}));
}

TEST(GltfFile, ARequiredExtensionThatIsNotUnderstoodIsRefusedByName) {
  GltfMaker maker = simple();
  maker.json["extensionsUsed"] = {"ACME_everything", "KHR_texture_basisu"};
  EXPECT_EQ(maker.import().mesh.triangles.size(), 1u) << "used, but not required";
  maker.json["extensionsRequired"] = {"KHR_mesh_quantization", "ACME_everything"};
  EXPECT_EQ(maker.refusal(),
            "import: error: tree: requires the extension 'ACME_everything', which is not understood; export "
            "the mesh without it");
}

TEST(GltfFile, AnEmptyAssetIsAMeshWithoutTriangles) {
  EXPECT_TRUE(good(read("{\"asset\":{\"version\":\"2.0\"}}", MeshFormat::gltf)).mesh.triangles.empty());
  EXPECT_TRUE(good(read(GltfMaker{}.glb(), MeshFormat::glb)).mesh.triangles.empty());
}

TEST(GltfFile, WrongTypesAnywhereAreRefusedNotGuessed) {
  const auto bent = [&](const char* pointer, const Json& value) {
    GltfMaker maker = simple();
    maker.json[Json::json_pointer(pointer)] = value;
    const std::string line = maker.refusal();
    return line.substr(21, line.find(';') - 21);
  };
  EXPECT_EQ(bent("/nodes/0/translation", "up"), "nodes[0].translation is not an array of 3 numbers");
  EXPECT_EQ(bent("/nodes/0/rotation", {0, 0, 1}), "nodes[0].rotation is not an array of 4 numbers");
  EXPECT_EQ(bent("/nodes/0/scale", {1, 1, "x"}), "nodes[0].scale[2] is not a number");
  EXPECT_EQ(bent("/nodes/0/matrix", {1}), "nodes[0].matrix is not an array of 16 numbers");
  EXPECT_EQ(bent("/nodes/0/mesh", "0"), "nodes[0].mesh is not a whole number from 0 up");
  EXPECT_EQ(bent("/asset/version", 2), "asset.version is not a text");
  EXPECT_EQ(bent("/accessors/0/normalized", 1), "accessors[0].normalized is not true or false");
}

}  // namespace
}  // namespace copse
