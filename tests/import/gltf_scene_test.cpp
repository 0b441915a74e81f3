// Where the nodes of a glTF scene put their meshes.
#include "tests/import/gltf_maker.h"

#include <cmath>
#include <numbers>

namespace copse {
namespace {

using namespace copse::testing;

// A maker with one triangle in mesh 0 and no node yet.
GltfMaker with_mesh(bool normals = false) {
  GltfMaker maker;
  Json attributes = {{"POSITION", maker.triangle()}};
  if (normals) attributes["NORMAL"] = maker.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  maker.add("meshes", {{"name", "leaf"}, {"primitives", Json::array({{{"attributes", attributes}}})}});
  return maker;
}

void expect_near(const Double3& a, const Double3& b) {
  EXPECT_NEAR(distance(a, b), 0, 1e-12) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(GltfScene, TranslationRotationAndScaleInThatOrder) {
  GltfMaker maker = with_mesh();
  const double h = std::numbers::sqrt2 / 2;  // 90 degrees about z
  maker.add("nodes",
            {{"mesh", 0}, {"translation", {10, 20, 30}}, {"rotation", {0, 0, h, h}}, {"scale", {2, 3, 4}}});
  const Import m = maker.import();
  expect_near(m.mesh.positions[0], {10, 20, 30});
  expect_near(m.mesh.positions[1], {10, 22, 30});
  expect_near(m.mesh.positions[2], {7, 20, 30});
}

TEST(GltfScene, AMatrixIsReadColumnByColumn) {
  GltfMaker maker = with_mesh();
  maker.add("nodes", {{"mesh", 0}, {"matrix", {0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 10, 20, 30, 1}}});
  const Import m = maker.import();
  expect_near(m.mesh.positions[1], {10, 22, 30});
  expect_near(m.mesh.positions[2], {7, 20, 30});
}

TEST(GltfScene, AQuaternionNeedNotHaveLengthOne) {
  GltfMaker maker = with_mesh();
  maker.add("nodes", {{"mesh", 0}, {"rotation", {0, 0, 5e-200, 5e-200}}});
  maker.add("nodes", {{"mesh", 0}, {"rotation", {0, 0, 0, 0}}});
  const Import m = maker.import();
  expect_near(m.mesh.positions[1], {0, 1, 0});
  expect_near(m.mesh.positions[4], {1, 0, 0});
}

TEST(GltfScene, ChildrenStandInTheirParents) {
  GltfMaker maker = with_mesh();
  maker.json["nodes"] = {
      {{"name", "tree"}, {"translation", {1, 0, 0}}, {"scale", {2, 2, 2}}, {"children", {1}}},
      {{"name", "twig"}, {"translation", {0, 1, 0}}, {"mesh", 0}}};
  const Import m = maker.import();
  expect_near(m.mesh.positions[0], {1, 2, 0});
  expect_near(m.mesh.positions[1], {3, 2, 0});
  EXPECT_EQ(m.mesh.parts, (std::vector<Part>{{"twig", "leaf", k_none}}));
}

TEST(GltfScene, ADistanceOfTenThousandKilometresKeepsTheShape) {
  GltfMaker maker = with_mesh();
  maker.add("nodes", {{"mesh", 0}, {"translation", {1e7, 0, 0}}, {"scale", {0.001, 0.001, 0.001}}});
  EXPECT_NEAR(maker.import().mesh.positions[1].x - 1e7, 0.001, 1e-8);
}

TEST(GltfScene, AMirroringNodeTurnsTheWindingRound) {
  GltfMaker maker = with_mesh(true);
  maker.add("nodes", {{"mesh", 0}, {"scale", {-1, 1, 1}}});
  const Import m = maker.import();
  EXPECT_EQ(triangles(m), (std::vector<Triangle>{{0, 2, 1}}));
  EXPECT_EQ(m.mesh.normals[0], (Float3{0, 0, 1}));
  const auto [a, b, c] = m.mesh.triangles[0];
  const auto& p = m.mesh.positions;
  EXPECT_GT(cross(p[b] - p[a], p[c] - p[a]).z, 0) << "the front still looks where the normal points";
}

TEST(GltfScene, NormalsTakeTheInverseTransposeAndKeepTheirLength) {
  GltfMaker maker;
  const float s = static_cast<float>(std::numbers::sqrt2 / 2);
  const Json attributes = {{"POSITION", maker.triangle()},
                           {"NORMAL", maker.accessor<float>({s, s, 0, 0, 0, 1, 0, 1, 0}, "VEC3")}};
  maker.show({{"attributes", attributes}}, {{"scale", {2, 1, 0}}});
  const Import m = maker.import();
  EXPECT_NEAR(m.mesh.normals[1].z, 1, 1e-6) << "defined although the matrix has no inverse";
  maker.json["nodes"][0]["scale"] = {2, 1, 1};
  const Float3 n = maker.import().mesh.normals[0];
  EXPECT_NEAR(n.x, 1 / std::sqrt(5.0), 1e-6);
  EXPECT_NEAR(n.y, 2 / std::sqrt(5.0), 1e-6);
}

TEST(GltfScene, AMeshMayBeShownManyTimes) {
  GltfMaker maker = with_mesh();
  for (int i = 0; i < 3; ++i)
    maker.add("nodes",
              {{"mesh", 0}, {"name", std::string(1, static_cast<char>(97 + i))}, {"translation", {i, 0, 0}}});
  const Import m = maker.import();
  EXPECT_EQ(m.mesh.triangles.size(), 3u);
  EXPECT_EQ(m.mesh.positions.size(), 9u);
  expect_near(m.mesh.positions[6], {2, 0, 0});
  EXPECT_EQ(m.mesh.parts.size(), 3u);
}

TEST(GltfScene, InstancingPlacesCopiesWithinTheNode) {
  GltfMaker maker = with_mesh();
  maker.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  const Json attributes = {
      {"TRANSLATION", maker.accessor<float>({0, 0, 0, 5, 0, 0}, "VEC3")},
      {"ROTATION", maker.accessor<std::int8_t>({0, 0, 0, 127, 0, 0, 127, 0}, "VEC4", true)},
      {"SCALE", maker.accessor<float>({1, 1, 1, 2, 2, 2}, "VEC3")}};
  maker.add("nodes", {{"mesh", 0},
                      {"translation", {0, 0, 7}},
                      {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", attributes}}}}}});
  const Import m = maker.import();
  ASSERT_EQ(m.mesh.triangles.size(), 2u);
  expect_near(m.mesh.positions[1], {1, 0, 7});
  expect_near(m.mesh.positions[4], {3, 0, 7});  // turned by 180 degrees, twice as large, moved by 5
  EXPECT_EQ(m.mesh.parts.size(), 1u);
}

TEST(GltfScene, NodesAndTheirInstancesAreGroups) {
  GltfMaker maker = with_mesh();
  maker.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  const Json two = {{"TRANSLATION", maker.accessor<float>({0, 0, 0, 5, 0, 0}, "VEC3")}};
  maker.json["nodes"] = {
      {{"name", "wood"}, {"children", {1, 2, 3, 4}}},
      {{"name", "oak"}, {"mesh", 0}},
      {{"name", "oak"}, {"mesh", 0}},
      {{"name", "nothing"}},
      {{"name", "ferns"}, {"mesh", 0}, {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", two}}}}}}};
  const Import m = maker.import();
  std::vector<std::pair<std::string, std::uint32_t>> groups;
  for (const SourceGroup& g : m.groups) groups.emplace_back(g.name, g.parent);
  EXPECT_EQ(groups, (std::vector<std::pair<std::string, std::uint32_t>>{
                        {"wood", k_none}, {"oak", 0}, {"oak", 0}, {"ferns", 0}, {"", 3}, {"", 3}}));
  EXPECT_EQ(m.group_of, (std::vector<std::uint32_t>{1, 2, 4, 5}));
}

TEST(GltfScene, InstancesCannotTakeMoreThanTheirLimit) {
  GltfMaker maker;
  maker.show({{"attributes", {{"POSITION", maker.triangle()}}}});
  std::vector<float> places(3 * 100'000);
  const Json attributes = {{"TRANSLATION", maker.accessor<float>(places, "VEC3")}};
  maker.json["nodes"][0]["extensions"] = {{"EXT_mesh_gpu_instancing", {{"attributes", attributes}}}};
  EXPECT_EQ(maker.import().mesh.triangles.size(), 100'000u);
  maker.json["accessors"][1] = {{"componentType", 5126}, {"count", 65'000}, {"type", "VEC3"}};
  maker.bin.resize(36);
  maker.json["bufferViews"].erase(1);
  const auto result = import_mesh(as_bytes(maker.glb()), MeshFormat::glb, "tree", {.instance_limit = 10'000});
  EXPECT_EQ(error_of(result),
            "import: error: tree: its scene has more than 10000 triangles or vertices; instance fewer copies "
            "of its meshes");
}

TEST(GltfScene, OnlyTheDefaultSceneIsRead) {
  GltfMaker maker = with_mesh();
  maker.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {5, 0, 0}}}};
  maker.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
  EXPECT_EQ(maker.import().mesh.positions[0].x, 0) << "the first one when none is said";
  maker.json["scene"] = 1;
  const Import m = maker.import();
  EXPECT_EQ(m.mesh.positions[0].x, 5);
  EXPECT_EQ(m.warnings,
            (std::vector<std::string>{"of 2 scenes only scenes[1] is read (scenes not read: 1)"}));
}

TEST(GltfScene, WithoutAnySceneAllRootsAreRead) {
  GltfMaker maker = with_mesh();
  maker.json["nodes"] = {{{"mesh", 0}}, {{"children", {2}}}, {{"mesh", 0}}};
  EXPECT_EQ(maker.import().mesh.triangles.size(), 2u);
}

TEST(GltfScene, ASceneThatNamesAChildShowsItOnce) {
  GltfMaker maker = with_mesh();
  maker.json["nodes"] = {{{"children", {1}}, {"translation", {5, 0, 0}}}, {{"mesh", 0}}};
  maker.json["scenes"] = {{{"nodes", {1}}}};
  EXPECT_EQ(maker.import().mesh.positions[0].x, 0) << "its parent is not in the scene";
  maker.json["scenes"] = {{{"nodes", {1, 0}}}};
  const Import m = maker.import();
  EXPECT_EQ(m.mesh.triangles.size(), 1u);
  EXPECT_EQ(m.mesh.positions[0].x, 5) << "its parent is";
  EXPECT_EQ(
      m.warnings,
      (std::vector<std::string>{
          "scenes[0] names nodes[1], which is a child of nodes[0] (scene nodes that have a parent: 1)"}));
}

TEST(GltfScene, CyclesAndSharedChildrenAreReadOnce) {
  GltfMaker maker = with_mesh();
  maker.json["nodes"] = {{{"mesh", 0}, {"children", {1}}}, {{"mesh", 0}, {"children", {0, 1}}}};
  maker.json["scenes"] = {{{"nodes", {0}}}};
  const Import m = maker.import();
  EXPECT_EQ(m.mesh.triangles.size(), 2u);
  EXPECT_FALSE(m.warnings.empty());
  maker.json["scenes"] = {{{"nodes", {0, 1, 0}}}};
  EXPECT_EQ(maker.import().mesh.triangles.size(), 2u);
}

TEST(GltfScene, AChainOfAHundredThousandNodesNeedsNoDeepStack) {
  GltfMaker maker = with_mesh();
  constexpr int k_length = 100'000;
  Json nodes = Json::array(), all = Json::array();
  for (int i = 0; i < k_length; ++i) {
    nodes.push_back(i + 1 < k_length ? Json{{"children", {i + 1}}, {"translation", {0, 1, 0}}}
                                     : Json{{"mesh", 0}});
    all.push_back(k_length - 1 - i);
  }
  maker.json["nodes"] = nodes;
  maker.json["scenes"] = {{{"nodes", all}}};
  EXPECT_EQ(maker.import().mesh.positions[0].y, k_length - 1);
}

TEST(GltfScene, APlaceThatOverflowsIsRefused) {
  GltfMaker maker = with_mesh();
  maker.json["nodes"] = {{{"scale", {1e200, 1, 1}}, {"children", {1}}},
                         {{"scale", {1e200, 1, 1}}, {"mesh", 0}}};
  EXPECT_NE(maker.refusal().find("vertex 0 is not finite where its node puts it"), std::string::npos);
}

TEST(GltfScene, SkinnedMeshesStandWhereTheirJointsAre) {
  GltfMaker maker;
  const Json attributes = {
      {"POSITION", maker.triangle()},
      {"JOINTS_0", maker.accessor<std::uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, "VEC4")},
      {"WEIGHTS_0", maker.accessor<float>({1, 0, 0, 0, 2, 0, 0, 0, 0.5, 0.5, 0, 0}, "VEC4")}};
  maker.show({{"attributes", attributes}}, {{"skin", 0}, {"translation", {1000, 0, 0}}});
  maker.add("nodes", {{"translation", {0, 0, 10}}, {"children", {2}}});
  maker.add("nodes", {{"translation", {0, 0, 10}}});
  maker.json["scenes"][0]["nodes"].push_back(1);
  maker.add("skins", {{"joints", {1, 2}}});
  const Import bare = maker.import();
  expect_near(bare.mesh.positions[0], {0, 0, 10});
  expect_near(bare.mesh.positions[1], {1, 0, 20});
  expect_near(bare.mesh.positions[2], {0, 1, 15});
  std::vector<float> inverse(32);
  for (const std::size_t i : {0u, 5u, 10u, 15u}) inverse[i] = inverse[16 + i] = 1;
  inverse[14] = -10;
  inverse[30] = -20;
  maker.json["skins"][0]["inverseBindMatrices"] = maker.accessor<float>(inverse, "MAT4");
  expect_near(maker.import().mesh.positions[2], {0, 1, 0});
}

TEST(GltfScene, JointsThatThereAreNotCountAsNone) {
  GltfMaker maker;
  const Json attributes = {
      {"POSITION", maker.triangle()},
      {"JOINTS_0", maker.accessor<std::int8_t>({-1, 0, 0, 0, 0, -128, 0, 0, 0, 127, 0, 0}, "VEC4")},
      {"WEIGHTS_0", maker.accessor<float>({1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0}, "VEC4")}};
  maker.show({{"attributes", attributes}}, {{"skin", 0}});
  maker.add("nodes", {{"translation", {0, 0, 10}}});
  maker.json["scenes"][0]["nodes"].push_back(1);
  maker.add("skins", {{"joints", {1}}});
  for (const Double3& p : maker.import().mesh.positions) EXPECT_NEAR(p.z, 10, 1e-6);
}

}  // namespace
}  // namespace copse
