#include "lib/analysis/leaves/part_verdicts.h"

#include "tests/leaves/shapes.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

// One triangle a part.
Mesh mesh_of(const std::vector<std::array<const char*, 3>>& material_group_object) {
  shapes::Builder b;
  b.mesh.parts.clear();
  for (const auto& [material, group, object] : material_group_object) {
    b.part(object, *material ? b.material(material) : k_none, group);
    b.triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  }
  return b.mesh;
}
std::vector<PartVerdict> verdicts(const Mesh& mesh, const ClassifyOptions& options = {}) {
  return part_verdicts(mesh, options).value();
}

TEST(PartVerdicts, TheMaterialsNameCountsBeforeTheGroupsAndTheObjects) {
  const auto v = verdicts(mesh_of(
      {{"bark", "leaves", "leaves"}, {"mat", "bark", "leaves"}, {"mat", "x", "leaves"}, {"", "", ""}}));
  EXPECT_EQ(v[0].reason, "material 'bark' says bark");
  EXPECT_EQ(v[1].reason, "group 'bark' says bark");
  EXPECT_EQ(v[2].reason, "object 'leaves' says leaves");
  EXPECT_EQ(v[2].kind, NameClass::leaf);
  EXPECT_EQ(v[2].binding, Binding::firm);
  EXPECT_EQ(v[3].binding, Binding::none);
}

TEST(PartVerdicts, WordsThatAreGivenToEitherAreWeak) {
  const auto v = verdicts(mesh_of({{"branch-1", "", ""}, {"leaf", "", ""}}));
  EXPECT_EQ(v[0].kind, NameClass::trunk);
  EXPECT_EQ(v[0].binding, Binding::weak);
}

TEST(PartVerdicts, ANameThatTheWholeMeshBearsDoesNotBind) {
  EXPECT_EQ(verdicts(mesh_of({{"Leaves", "", ""}}))[0].binding, Binding::whole);
  EXPECT_EQ(verdicts(mesh_of({{"", "", "grass-tile"}}))[0].binding, Binding::none);
  EXPECT_EQ(verdicts(mesh_of({{"Leaves", "", ""}, {"m1", "", ""}}))[0].binding, Binding::firm);
}

TEST(PartVerdicts, PartsThatNoTriangleUsesDoNotCount) {
  Mesh mesh = mesh_of({{"Leaves", "", ""}});
  mesh.parts.push_back({"bark", "", k_none});
  EXPECT_EQ(verdicts(mesh)[0].binding, Binding::whole);
}

TEST(PartVerdicts, PatternsBindAndTheOthersAreReadAsUsual) {
  const auto v = verdicts(mesh_of({{"leaf", "", "a"}, {"leaf", "", "b"}, {"bark", "", "c"}}),
                          {.trunk_patterns = {"a"}, .leaf_patterns = {}});
  EXPECT_EQ(v[0].kind, NameClass::trunk);
  EXPECT_EQ(v[0].reason, "--trunk 'a' matches object 'a'");
  EXPECT_EQ(v[1].kind, NameClass::leaf);
  EXPECT_EQ(v[2].kind, NameClass::trunk);
}

TEST(PartVerdicts, ErrorsListTwelveNamesAndCountTheRest) {
  std::vector<std::array<const char*, 3>> parts;
  std::vector<std::string> names;
  for (int i = 0; i < 30; ++i) names.emplace_back("p").append(std::to_string(100 + i));
  for (const std::string& name : names) parts.push_back({"", "", name.c_str()});
  const auto v = part_verdicts(mesh_of(parts), {.trunk_patterns = {"zzz"}, .leaf_patterns = {}});
  ASSERT_FALSE(v.has_value());
  EXPECT_NE(v.error().remedy.find("'p100', 'p101'"), std::string::npos);
  EXPECT_NE(v.error().remedy.find("and 18 more"), std::string::npos);
  const auto none = part_verdicts(mesh_of({{"", "", ""}}), {.trunk_patterns = {"?*"}, .leaf_patterns = {}});
  ASSERT_FALSE(none.has_value());
  EXPECT_NE(none.error().remedy.find("no names"), std::string::npos);
}

TEST(PartVerdicts, NothingNamesNothing) {
  const auto v = part_verdicts(mesh_of({{"bark", "", ""}}), {.trunk_patterns = {}, .leaf_patterns = {""}});
  ASSERT_FALSE(v.has_value());
  EXPECT_EQ(v.error().what, "--leaf '' matches no material, group or object");
}

TEST(PartVerdicts, AStarAloneTakesWhatHasNoName) {
  const auto v = verdicts(mesh_of({{"", "", ""}}), {.trunk_patterns = {"*"}, .leaf_patterns = {}});
  EXPECT_EQ(v[0].kind, NameClass::trunk);
  EXPECT_EQ(v[0].reason, "--trunk '*' matches a material without a name");
}

TEST(PartVerdicts, AMaterialIndexOutOfRangeIsNoMaterial) {
  Mesh mesh = mesh_of({{"", "", "bark"}});
  mesh.parts[0].material = 7;
  EXPECT_EQ(verdicts(mesh)[0].kind, NameClass::trunk);
}

}  // namespace
}  // namespace copse
