#include "lib/formats/export/instancing.h"

#include "lib/formats/export/export.h"
#include "tests/export/glb_file.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

std::string little_glb() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  mesh.part_of = {0, 1};
  mesh.parts = {{.object = "oak", .group = "oak"}, {.object = "ground", .group = "ground"}};
  const auto files = export_mesh(mesh, ExportFormat::glb, "x.glb");
  EXPECT_TRUE(files);
  return files->front().bytes;
}

std::vector<float> numbers(const GlbFile& glb, std::size_t accessor, std::size_t width) {
  const auto& a = glb.json["accessors"][accessor];
  const auto& view = glb.json["bufferViews"][a["bufferView"].get<std::size_t>()];
  std::vector<float> values(a["count"].get<std::size_t>() * width);
  EXPECT_EQ(view["byteLength"], values.size() * sizeof(float));
  std::memcpy(values.data(), glb.binary.data() + view["byteOffset"].get<std::size_t>(),
              values.size() * sizeof(float));
  return values;
}

TEST(Instancing, ANodeGetsItsInstancesAndTheOthersStay) {
  const NodeInstances oaks{"oak", {{1, 2, 3}, {4, 5, 6}}, {{0, 0, 0, 1}, {0, 1, 0, 0}}, {1, 2}};
  const auto bytes = with_instances(little_glb(), std::vector{oaks}, {});
  ASSERT_TRUE(bytes) << bytes.error().what;
  const GlbFile glb = take_apart(*bytes);
  std::size_t instanced = 0;
  for (const auto& node : glb.json["nodes"]) {
    if (!node.contains("extensions")) continue;
    ++instanced;
    EXPECT_EQ(node["name"], "oak");
    const auto& attributes = node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    EXPECT_EQ(numbers(glb, attributes["TRANSLATION"], 3), (std::vector<float>{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(numbers(glb, attributes["ROTATION"], 4), (std::vector<float>{0, 0, 0, 1, 0, 1, 0, 0}));
    EXPECT_EQ(numbers(glb, attributes["SCALE"], 3), (std::vector<float>{1, 1, 1, 2, 2, 2}));
  }
  EXPECT_EQ(instanced, 1u);
  EXPECT_EQ(glb.json["extensionsUsed"], nlohmann::json::array({"EXT_mesh_gpu_instancing"}));
  EXPECT_EQ(glb.json["extensionsRequired"], nlohmann::json::array({"EXT_mesh_gpu_instancing"}));
}

TEST(Instancing, ColoursAreAnAttributeOfTheirOwnWhereThereAreAny) {
  const NodeInstances oaks{
      "oak", {{1, 2, 3}, {4, 5, 6}}, {{0, 0, 0, 1}, {0, 1, 0, 0}}, {1, 2}, {{1, 0.5f, 0}, {0, 1, 1}}},
      ground{"ground", {{0, 0, 0}}, {{0, 0, 0, 1}}, {1}};
  const auto bytes = with_instances(little_glb(), std::vector{oaks, ground}, {});
  ASSERT_TRUE(bytes) << bytes.error().what;
  const GlbFile glb = take_apart(*bytes);
  for (const auto& node : glb.json["nodes"]) {
    if (!node.contains("extensions")) continue;
    const auto& attributes = node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    ASSERT_EQ(attributes.contains("_COLOR_0"), node["name"] == "oak");
    if (node["name"] != "oak") continue;
    EXPECT_EQ(numbers(glb, attributes["_COLOR_0"], 3), (std::vector<float>{1, 0.5f, 0, 0, 1, 1}));
  }
}

TEST(Instancing, AsNodesEachInstanceIsAChildThatSharesTheMesh) {
  const NodeInstances oaks{"oak", {{1, 2, 3}, {4, 5, 6}}, {{0, 0, 0, 1}, {0, 1, 0, 0}}, {1, 2}};
  const auto bytes = with_instances(little_glb(), std::vector{oaks}, {}, Instancing::nodes);
  ASSERT_TRUE(bytes) << bytes.error().what;
  const GlbFile glb = take_apart(*bytes);
  EXPECT_FALSE(glb.json.contains("extensionsRequired"));
  const auto& nodes = glb.json["nodes"];
  std::size_t parents = 0;
  for (const auto& node : nodes) {
    if (node["name"] != "oak") continue;
    ++parents;
    EXPECT_FALSE(node.contains("mesh"));
    ASSERT_EQ(node["children"].size(), 2u);
    const auto& second = nodes[node["children"][1].get<std::size_t>()];
    EXPECT_EQ(second["mesh"], nodes[node["children"][0].get<std::size_t>()]["mesh"]);
    EXPECT_EQ(second["translation"], (std::vector<float>{4, 5, 6}));
    EXPECT_EQ(second["rotation"], (std::vector<float>{0, 1, 0, 0}));
    EXPECT_EQ(second["scale"], (std::vector<float>{2, 2, 2}));
  }
  EXPECT_EQ(parents, 1u);
  NodeInstances many{"oak", std::vector<Float3>(k_most_nodes + 1), {}, {}};
  EXPECT_FALSE(with_instances(little_glb(), std::vector{many}, {}, Instancing::nodes));
}

TEST(Instancing, AnOriginIsTheTranslationOfARoot) {
  const auto bytes = with_instances(little_glb(), {}, {1e7, 5, -3});
  ASSERT_TRUE(bytes);
  const GlbFile glb = take_apart(*bytes);
  const auto root = glb.json["scenes"][0]["nodes"];
  ASSERT_EQ(root.size(), 1u);
  EXPECT_EQ(glb.json["nodes"][root[0].get<std::size_t>()]["translation"], (std::vector<double>{1e7, 5, -3}));
  EXPECT_EQ(glb.json["nodes"][root[0].get<std::size_t>()]["children"].size(), 2u);
  EXPECT_FALSE(glb.json.contains("extensionsUsed"));
}

TEST(Instancing, AnUnknownNodeIsRefusedAndNoInstancesAreNone) {
  const NodeInstances pines{"pine", {{1, 2, 3}}, {{0, 0, 0, 1}}, {1}};
  EXPECT_FALSE(with_instances(little_glb(), std::vector{pines}, {}));
  EXPECT_TRUE(with_instances(little_glb(), std::vector{NodeInstances{"pine", {}, {}, {}}}, {}));
}

}  // namespace
}  // namespace copse
