#include "lib/analysis/leaves/stand_ins.h"

#include "tests/leaves/shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace copse {
namespace {

using shapes::Builder;
using shapes::line;
using testing::ElementsAre;

// A tube in each object.
Mesh mesh_of(const std::vector<std::string>& objects) {
  Builder b;
  for (const std::string& object : objects) {
    b.part(object);
    b.tube(line({0, 0, 0}, {0, 5, 0}, 3), 0.2, 6);
  }
  return b.mesh;
}
std::vector<std::string> left_out(const Mesh& mesh, const std::vector<std::string>& kept = {}) {
  std::vector<std::string> names;
  for (const StandIn& s : find_stand_ins(mesh, kept)) names.push_back(s.name);
  return names;
}

TEST(StandIns, NamesOfEnginesSayCollisionHull) {
  for (const char* name : {"UCX_oak_01", "ubx_trunk", "USP_x", "UCP_x", "MCDCX_oak", "oak_Collision",
                           "OakCollider", "tree-colonly", "Tree-convcolonly", "hitbox"})
    EXPECT_NE(hull_word(name), "") << name;
  for (const char* name : {"", "oak", "UCX", "UCXoak", "oak-col", "colour", "collisional", "Broccoli"})
    EXPECT_EQ(hull_word(name), "") << name;
}

TEST(StandIns, ALevelIsAWordWithANumber) {
  EXPECT_EQ(lod_name("Oak_LOD2_bark"), (LodName{"oak_", 2}));
  EXPECT_EQ(lod_name("lod0"), (LodName{"", 0}));
  EXPECT_EQ(lod_name("OakLOD1"), (LodName{"oak", 1}));
  EXPECT_EQ(lod_name("oak.lod_3"), (LodName{"oak.", 3}));
  EXPECT_EQ(lod_name("lodge_LOD10"), (LodName{"lodge_", 10}));
  for (const char* name : {"", "lod", "Oak_LOD", "melod1", "MELOD1", "explode2", "oak_lod2026"})
    EXPECT_EQ(lod_name(name), std::nullopt) << name;
}

TEST(StandIns, HullsAndCoarserLevelsAreLeftOut) {
  EXPECT_THAT(left_out(mesh_of({"oak_LOD0", "oak_LOD1", "oak_LOD2", "UCX_oak", "pine"})),
              ElementsAre("oak_LOD1", "oak_LOD2", "UCX_oak"));
  EXPECT_THAT(left_out(mesh_of({"oak_LOD0", "pine_LOD1", "UCX_oak_LOD0"})), ElementsAre("UCX_oak_LOD0"));
  EXPECT_THAT(left_out(mesh_of({"oak_LOD2", "oak_LOD1"})), ElementsAre("oak_LOD2"));
  EXPECT_TRUE(left_out(mesh_of({"oak", "pine"})).empty());
}

TEST(StandIns, AMeshOfNothingElseIsKept) {
  EXPECT_TRUE(left_out(mesh_of({"UCX_oak", "UCX_pine"})).empty());
  EXPECT_TRUE(left_out(Mesh{}).empty());
}

TEST(StandIns, APatternThatSpellsTheWordKeepsThem) {
  const Mesh mesh = mesh_of({"oak_LOD0", "oak_LOD1", "UCX_oak"});
  EXPECT_THAT(left_out(mesh, {"*oak*", "*"}), ElementsAre("oak_LOD1", "UCX_oak"));
  EXPECT_THAT(left_out(mesh, {"*_lod1"}), ElementsAre("UCX_oak"));
  EXPECT_THAT(left_out(mesh, {"ucx_*"}), ElementsAre("oak_LOD1"));
}

TEST(StandIns, WhatIsTakenOutTakesItsPositionsAlong) {
  Builder b;
  b.part("oak");
  b.card({0, 1, 0}, {1, 0, 0}, {0, 1, 0});
  b.part("UCX_oak");
  b.card({9, 9, 9}, {1, 0, 0}, {0, 1, 0});
  b.triangle(0, 1, 4);  // shares two positions with the oak
  b.part("oak");
  b.card({0, 3, 0}, {1, 0, 0}, {0, 1, 0});
  b.mesh.texcoords.resize(1);
  b.mesh.texcoord_triangles.assign(7, {0, 0, 0});
  const Mesh before = b.mesh;
  EXPECT_THAT(remove_parts(b.mesh, std::vector<std::uint32_t>{2}), ElementsAre(0, 1, 5, 6));
  EXPECT_EQ(b.mesh.positions.size(), 8u);
  EXPECT_EQ(b.mesh.texcoord_triangles.size(), 4u);
  EXPECT_EQ(b.mesh.part_of, (std::vector<std::uint32_t>{1, 1, 3, 3}));
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(b.mesh.positions[b.mesh.triangles[3][c]], before.positions[before.triangles[6][c]]);
  }
  EXPECT_EQ(bounds(b.mesh).max.x, 1);
}

}  // namespace
}  // namespace copse
