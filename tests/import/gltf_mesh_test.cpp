// What glTF meshes are made of: buffers, accessors, primitives.
#include "tests/import/gltf_maker.h"

namespace copse {
namespace {

using namespace copse::testing;

const std::vector<Double3> k_square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const std::vector<Triangle> k_two{{0, 1, 2}, {0, 2, 3}};

TEST(GltfMesh, ATriangleWithoutIndices) {
  GltfMaker maker;
  maker.show({{"attributes", {{"POSITION", maker.triangle()}}}});
  const Import m = maker.import();
  EXPECT_EQ(m.format, MeshFormat::glb);
  EXPECT_EQ(m.mesh.positions, (std::vector<Double3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(triangles(m), (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_TRUE(m.warnings.empty());
  expect_sound(m.mesh);
}

template <class Index>
void expect_square_with() {
  GltfMaker maker;
  const int indices = maker.accessor<Index>({0, 1, 2, 0, 2, 3}, "SCALAR");
  maker.show({{"attributes", {{"POSITION", maker.square()}}}, {"indices", indices}});
  EXPECT_EQ(triangles(maker.import()), k_two);
}

TEST(GltfMesh, EveryIndexType) {
  expect_square_with<std::uint8_t>();
  expect_square_with<std::uint16_t>();
  expect_square_with<std::uint32_t>();
}

TEST(GltfMesh, NormalsAndTexcoordsWithVRunningUp) {
  GltfMaker maker;
  const Json attributes = {{"POSITION", maker.triangle()},
                           {"NORMAL", maker.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3")},
                           {"TEXCOORD_0", maker.accessor<float>({0, 0, 1, 0.25, 0, 1}, "VEC2")}};
  maker.show({{"attributes", attributes}});
  const Import m = maker.import();
  EXPECT_EQ(m.mesh.normals, (std::vector<Float3>(3, {0, 0, 1})));
  EXPECT_EQ(m.mesh.texcoords, (std::vector<Float2>{{0, 1}, {1, 0.75f}, {0, 0}}));
  EXPECT_EQ(m.mesh.normal_triangles, m.mesh.triangles);
  EXPECT_EQ(m.mesh.texcoord_triangles, m.mesh.triangles);
}

TEST(GltfMesh, InterleavedAttributes) {
  GltfMaker maker;
  const int view = maker.view<float>({9, 0, 0, 0, 0, 0.5, 9, 1, 0, 0, 1, 0.5, 9, 0, 1, 0, 0, 1}, 24);
  const auto accessor = [&](int offset, const char* type) {
    return maker.add("accessors", {{"bufferView", view},
                                   {"byteOffset", offset},
                                   {"componentType", 5126},
                                   {"count", 3},
                                   {"type", type}});
  };
  maker.show({{"attributes", {{"POSITION", accessor(4, "VEC3")}, {"TEXCOORD_0", accessor(16, "VEC2")}}}});
  const Import m = maker.import();
  EXPECT_EQ(m.mesh.positions, (std::vector<Double3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(m.mesh.texcoords, (std::vector<Float2>{{0, 0.5f}, {1, 0.5f}, {0, 0}}));
}

TEST(GltfMesh, QuantizedAttributesBecomeFractionsWhereNormalized) {
  GltfMaker maker;
  maker.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  const int positions =
      maker.accessor<std::int16_t>({0, 0, 0, 0, 32767, 0, 0, 0, -32768, -32767, 0, 0}, "VEC4", true);
  maker.json["accessors"][0]["type"] = "VEC3";
  maker.json["accessors"][0]["count"] = 3;
  maker.json["bufferViews"][0]["byteStride"] = 8;
  const int normals = maker.accessor<std::int8_t>({127, 0, 0, 0, 0, -128, 0, 0, 0, 0, 127, 0}, "VEC4", true);
  maker.json["accessors"][1]["type"] = "VEC3";
  maker.json["bufferViews"][1]["byteStride"] = 4;
  const int uvs = maker.accessor<std::uint16_t>({65535, 0, 0, 65535, 0, 0}, "VEC2", true);
  maker.show({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uvs}}}});
  const Import m = maker.import();
  EXPECT_EQ(m.mesh.positions, (std::vector<Double3>{{0, 0, 0}, {1, 0, 0}, {-1, -1, 0}}));
  EXPECT_EQ(m.mesh.normals, (std::vector<Float3>{{1, 0, 0}, {0, -1, 0}, {0, 0, 1}}));
  EXPECT_EQ(m.mesh.texcoords, (std::vector<Float2>{{1, 1}, {0, 0}, {0, 1}}));

  GltfMaker plain;
  plain.show({{"attributes",
               {{"POSITION", plain.accessor<std::uint16_t>({0, 0, 0, 40000, 0, 0, 0, 7, 0}, "VEC3")}}}});
  EXPECT_EQ(plain.import().mesh.positions[1], (Double3{40000, 0, 0}));
}

TEST(GltfMesh, SparseAccessorsWithAndWithoutABase) {
  GltfMaker maker;
  const int positions = maker.triangle();
  const int indices = maker.view<std::uint8_t>({2, 1});
  const int values = maker.view<float>({5, 6, 7, 8, 9, 10});
  const Json sparse = {{"count", 2},
                       {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                       {"values", {{"bufferView", values}}}};
  maker.json["accessors"][0]["sparse"] = sparse;
  const int bare =
      maker.add("accessors", {{"componentType", 5126}, {"count", 3}, {"type", "VEC3"}, {"sparse", sparse}});
  maker.show({{"attributes", {{"POSITION", positions}}}});
  maker.show({{"attributes", {{"POSITION", bare}}}});
  EXPECT_EQ(maker.import().mesh.positions,
            (std::vector<Double3>{{0, 0, 0}, {8, 9, 10}, {5, 6, 7}, {0, 0, 0}, {8, 9, 10}, {5, 6, 7}}));
}

TEST(GltfMesh, SparseIndices) {
  GltfMaker maker;
  const int positions = maker.square();
  const int order = maker.accessor<std::uint16_t>({0, 1, 2}, "SCALAR");
  maker.json["accessors"][1]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", maker.view<std::uint16_t>({2})}, {"componentType", 5123}}},
      {"values", {{"bufferView", maker.view<std::uint16_t>({3})}}}};
  maker.show({{"attributes", {{"POSITION", positions}}}, {"indices", order}});
  EXPECT_EQ(triangles(maker.import()), (std::vector<Triangle>{{0, 1, 3}}));
}

TEST(GltfMesh, StripsKeepTheirWindingAndLoseTheirStitches) {
  GltfMaker maker;
  const int positions = maker.accessor<float>({0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 2, 0, 0}, "VEC3");
  const int order = maker.accessor<std::uint8_t>({0, 1, 2, 3, 3, 2, 2, 3, 4}, "SCALAR");
  maker.show({{"attributes", {{"POSITION", positions}}}, {"indices", order}, {"mode", 5}});
  const Import m = maker.import();
  EXPECT_EQ(triangles(m), (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
  EXPECT_EQ(m.counts.dropped_faces, 0u);
}

TEST(GltfMesh, FansTurnRoundTheirFirstVertex) {
  GltfMaker maker;
  maker.show({{"attributes", {{"POSITION", maker.square()}}}, {"mode", 6}});
  EXPECT_EQ(triangles(maker.import()), (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(GltfMesh, PointsAndLinesAreSkippedWithAWarning) {
  GltfMaker maker;
  const int positions = maker.square();
  for (int mode = 0; mode < 4; ++mode)
    maker.show({{"attributes", {{"POSITION", positions}}}, {"mode", mode}});
  maker.show({{"attributes", {{"POSITION", positions}}},
              {"mode", 4},
              {"indices", maker.accessor<std::uint8_t>({0, 1, 2}, "SCALAR")}});
  maker.show({{"attributes", Json::object()}});
  const Import m = maker.import();
  EXPECT_EQ(m.mesh.triangles.size(), 1u);
  EXPECT_EQ(m.warnings,
            (std::vector<std::string>{
                "meshes[0].primitives[0] has no triangles (primitives of lines and points skipped: 4)",
                "meshes[5].primitives[0] has no POSITION (primitives without positions skipped: 1)"}));
}

TEST(GltfMesh, PrimitivesOfOneMeshShareTheirVertices) {
  GltfMaker maker;
  const int positions = maker.square();
  const auto primitive = [&](std::vector<std::uint8_t> order) -> Json {
    return {{"attributes", {{"POSITION", positions}}},
            {"indices", maker.accessor<std::uint8_t>(order, "SCALAR")}};
  };
  maker.show(primitive({0, 1, 2}));
  maker.json["meshes"][0]["primitives"].push_back(primitive({0, 2, 3}));
  const Import m = maker.import();
  EXPECT_EQ(m.mesh.positions, k_square);
  EXPECT_EQ(triangles(m), k_two);
}

TEST(GltfMesh, IndicesOutOfRangeAreDroppedWithACountOrRefused) {
  GltfMaker maker;
  const int positions = maker.square();
  maker.show(
      {{"attributes", {{"POSITION", positions}}},
       {"indices", maker.accessor<std::uint16_t>({0, 1, 2, 0, 2, 4, 0, 65535, 1, 0, 0, 1, 0}, "SCALAR")}});
  const Import m = maker.import();
  EXPECT_EQ(triangles(m), (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_EQ(m.counts.dropped_faces, 3u);
  EXPECT_EQ(
      m.warnings,
      (std::vector<std::string>{
          "meshes[0].primitives[0]: 13 indices are no whole triangles (incomplete triangles skipped: 1)",
          "meshes[0].primitives[0]: triangle 1: names vertex 4 of 4 (faces dropped: 3)"}));
  EXPECT_EQ(maker.refusal(true),
            "import: error: tree: meshes[0].primitives[0]: triangle 1: names vertex 4 of 4; export the mesh "
            "again, or drop "
            "--strict to leave it out");
}

TEST(GltfMesh, PositionsThatAreNotFiniteAreRefusedAndNormalsDropped) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  GltfMaker maker;
  maker.show({{"attributes", {{"POSITION", maker.accessor<float>({0, 0, 0, 1, nan, 0, 0, 1, 0}, "VEC3")}}}});
  EXPECT_EQ(maker.refusal(),
            "import: error: tree: meshes[0].primitives[0]: vertex 1 is not finite; export the mesh again, or "
            "check it with the "
            "glTF validator");
  GltfMaker normals;
  const Json attributes = {{"POSITION", normals.triangle()},
                           {"NORMAL", normals.accessor<float>({0, 0, 1, nan, nan, nan, 0, 0, 1}, "VEC3")},
                           {"TEXCOORD_0", normals.accessor<float>({0, 0, 1, 1, nan, 0}, "VEC2")}};
  normals.show({{"attributes", attributes}});
  const Import m = normals.import();
  EXPECT_EQ(m.mesh.normal_triangles, (std::vector<Triangle>{{0, k_none, 2}}));
  EXPECT_EQ(m.mesh.texcoord_triangles, (std::vector<Triangle>{{0, 1, k_none}}));
  expect_sound(m.mesh);
}

TEST(GltfMesh, BuffersMayBeDataUrisOrFilesBesideTheMesh) {
  GltfMaker maker;
  maker.show({{"attributes", {{"POSITION", maker.triangle()}}}});
  Json text = maker.json;
  text["buffers"] = Json::array({{{"byteLength", maker.bin.size()},
                                  {"uri", "data:application/octet-stream;base64," + base64(maker.bin)}}});
  EXPECT_EQ(good(read(text.dump(2), MeshFormat::unknown)).mesh.triangles.size(), 1u);

  const Folder folder;
  const auto buffer = folder.write("sub/my tree.bin", maker.bin);
  text["buffers"][0]["uri"] = "sub/my%20tree.bin";
  const auto path = folder.write("tree.gltf", text.dump());
  const Import m = good(import_mesh(path));
  EXPECT_EQ(m.format, MeshFormat::gltf);
  EXPECT_EQ(m.files, (std::vector<std::filesystem::path>{path, buffer}));

  folder.write("tree.gltf.gz", gzipped(text.dump()));
  EXPECT_EQ(good(import_mesh(folder.path() / "tree.gltf.gz")).mesh.triangles.size(), 1u);
}

TEST(GltfMesh, BuffersOutsideTheFolderOrMissingOrShortAreRefused) {
  GltfMaker maker;
  maker.show({{"attributes", {{"POSITION", maker.triangle()}}}});
  const Folder folder;
  folder.write("tree.bin", maker.bin);
  folder.write("short.bin", maker.bin.substr(1));
  const auto refusal = [&](const std::string& uri) {
    Json text = maker.json;
    text["buffers"] = Json::array({{{"byteLength", maker.bin.size()}, {"uri", uri}}});
    const std::string line = error_of(import_mesh(folder.write("sub/tree.gltf", text.dump())));
    return line.substr(line.find("tree.gltf: ") + 11);
  };
  EXPECT_NE(refusal("../tree.bin").find("not below its own folder"), std::string::npos);
  EXPECT_NE(refusal("http://example.org/tree.bin").find("No such file"), std::string::npos);
  EXPECT_NE(refusal("%2e%2e/tree.bin").find("not below its own folder"), std::string::npos);
  folder.write("sub/short.bin", maker.bin.substr(1));
  EXPECT_EQ(refusal("short.bin"),
            "buffers[0] has 35 bytes instead of 36; copy the file again: its end is missing");
  EXPECT_EQ(
      refusal("data:x;base64,????"),
      "buffers[0].uri is a damaged data URI; export the mesh again, or check it with the glTF validator");
}

// Whatever a number in the JSON says, nothing beyond the buffer is read.
TEST(GltfMesh, EveryRangeIsCheckedAndNamed) {
  GltfMaker maker;
  maker.show({{"attributes", {{"POSITION", maker.triangle()}}},
              {"indices", maker.accessor<std::uint8_t>({0, 1, 2}, "SCALAR")}});
  const auto bent = [&](const std::string& pointer, const Json& value) {
    GltfMaker other = maker;
    other.json[Json::json_pointer(pointer)] = value;
    std::string line = other.refusal();
    const std::string head = "import: error: tree: ";
    return line.starts_with(head) ? line.substr(head.size(), line.find(';') - head.size()) : line;
  };
  EXPECT_EQ(bent("/accessors/0/count", 4),
            "accessors[0]: 4 elements from byte 0 reach beyond bufferViews[0] of 36 bytes");
  EXPECT_EQ(bent("/accessors/0/count", 4294967295u), "accessors[0]: has 4294967295 elements");
  EXPECT_EQ(bent("/accessors/0/count", -1), "accessors[0].count is not a whole number from 0 up");
  EXPECT_EQ(bent("/accessors/0/count", 1.5), "accessors[0].count is not a whole number from 0 up");
  EXPECT_EQ(bent("/accessors/0/count", "3"), "accessors[0].count is not a whole number from 0 up");
  EXPECT_EQ(bent("/accessors/0/byteOffset", 1),
            "accessors[0]: 3 elements from byte 1 reach beyond bufferViews[0] of 36 bytes");
  EXPECT_EQ(
      bent("/accessors/0/byteOffset", 18446744073709551615u),
      "accessors[0]: 3 elements from byte 18446744073709551615 reach beyond bufferViews[0] of 36 bytes");
  EXPECT_EQ(bent("/accessors/0/bufferView", 9), "accessors[0].bufferView is 9, but there are only 2");
  EXPECT_EQ(bent("/accessors/0/componentType", 5130),
            "accessors[0]: 'VEC3' of component type 5130 cannot be read");
  EXPECT_EQ(bent("/accessors/0/type", "VEC9"), "accessors[0]: 'VEC9' of component type 5126 cannot be read");
  EXPECT_EQ(bent("/accessors/0/type", "VEC2"),
            "meshes[0].primitives[0]: POSITION: accessors[0] has too few components");
  EXPECT_EQ(bent("/accessors/1/componentType", 5120),
            "accessors[1] holds no indices: they are unsigned scalars");
  EXPECT_EQ(bent("/bufferViews/0/byteStride", 4), "accessors[0]: elements of 12 bytes lie 4 apart");
  EXPECT_EQ(bent("/bufferViews/0/byteStride", 9223372036854775808u),
            "accessors[0]: 3 elements from byte 0 reach beyond bufferViews[0] of 36 bytes");
  EXPECT_EQ(bent("/bufferViews/0/byteLength", 40), "bufferViews[0]: bytes 0 to 40 of a buffer of 39");
  EXPECT_EQ(bent("/bufferViews/0/byteOffset", 18446744073709551615u),
            "bufferViews[0]: bytes 18446744073709551615 to 35 of a buffer of 39");
  EXPECT_EQ(bent("/bufferViews/0/buffer", 1), "bufferViews[0].buffer is 1, but there are only 1");
  EXPECT_EQ(bent("/nodes/0/mesh", 1), "nodes[0].mesh is 1, but there are only 1");
  EXPECT_EQ(bent("/meshes/0/primitives/0/material", 0),
            "meshes[0].primitives[0].material is 0, but there are only 0");
  EXPECT_EQ(bent("/meshes/0/primitives/0/mode", 7), "meshes[0].primitives[0].mode is 7");
  EXPECT_EQ(bent("/meshes/0/primitives/0/attributes/POSITION", 2),
            "meshes[0].primitives[0].attributes.POSITION is 2, but there are only 2");
  EXPECT_EQ(bent("/meshes/0/primitives/0/attributes/NORMAL", 1),
            "meshes[0].primitives[0]: NORMAL: accessors[1] has too few components");
  EXPECT_EQ(bent("/meshes/0/primitives/0/indices", 5),
            "meshes[0].primitives[0].indices is 5, but there are only 2");
  EXPECT_EQ(bent("/scenes/0/nodes/0", 7), "scenes[0].nodes[0] is 7, but there are only 1");
  EXPECT_EQ(bent("/scene", 1), "scene is 1, but there are only 1");
  const Json sparse = {{"count", 4},
                       {"indices", {{"bufferView", 0}, {"componentType", 5121}}},
                       {"values", {{"bufferView", 0}}}};
  EXPECT_EQ(bent("/accessors/0/sparse", sparse), "accessors[0]: 4 sparse elements of 3");
}

TEST(GltfMesh, AnAccessorWithoutDataCannotTakeMemoryForNothing) {
  GltfMaker maker;
  maker.show(
      {{"attributes",
        {{"POSITION",
          maker.add("accessors", {{"componentType", 5126}, {"count", 4000000000u}, {"type", "VEC3"}})}}}});
  EXPECT_NE(maker.refusal().find("its scene has more than 16777216 triangles or vertices"),
            std::string::npos);
  maker.json["accessors"][0]["count"] = 100000;
  EXPECT_NE(maker.refusal().find("accessors[0]: 100000 elements without a buffer view"), std::string::npos);
}

TEST(GltfMesh, APrimitiveWithoutVerticesIsNoTriangles) {
  GltfMaker maker;
  const Json none = {{"componentType", 5126}, {"count", 0}, {"type", "VEC3"}};
  const int empty = maker.add("accessors", none);
  maker.show({{"attributes", {{"POSITION", empty}, {"NORMAL", empty}}}});
  const Import m = maker.import();
  EXPECT_TRUE(m.mesh.positions.empty());
  EXPECT_TRUE(m.mesh.triangles.empty());
}

TEST(GltfMesh, MorphTargetsAndVertexColoursAreLeftOutWithAWarning) {
  GltfMaker maker;
  const int positions = maker.triangle();
  maker.show({{"attributes", {{"POSITION", positions}, {"COLOR_0", positions}}},
              {"targets", Json::array({{{"POSITION", positions}}})}});
  EXPECT_EQ(maker.import().warnings,
            (std::vector<std::string>{
                "meshes[0].primitives[0] is read without its morph targets (morph targets left out: 1)",
                "meshes[0].primitives[0] is read without COLOR_0 (vertex colours left out: 1)"}));
}

}  // namespace
}  // namespace copse
