#include "lib/analysis/tree/default_materials.h"

#include "lib/formats/default_look.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

constexpr Float3 k_own{0.5f, 0.25f, 0.75f};

// A tree of two trunk triangles and two leaves of two triangles, made of nothing.
Tree bare() {
  Tree tree;
  tree.trunk.triangles = std::vector<CornerTriangle>(2);
  tree.leaves.triangles = std::vector<CornerTriangle>(4);
  tree.leaves.centres = std::vector<Float3>(2);
  tree.leaves.order = std::vector<std::uint32_t>{0, 1};
  return tree;
}

TEST(DefaultMaterials, WoodIsBrownAndLeavesAreGreenWhereNothingSaysHowTheyLook) {
  Tree tree = bare();
  give_default_materials({}, tree);
  ASSERT_EQ(tree.materials.size(), 2u);
  EXPECT_EQ(tree.materials.at(tree.trunk.material).diffuse, k_wood_colour);
  EXPECT_EQ(tree.materials.at(tree.leaves.material).diffuse, k_leaf_colour);
}

TEST(DefaultMaterials, WhatHasAMaterialKeepsIt) {
  Tree tree = bare();
  tree.materials = {{.name = "a", .diffuse = k_own}};
  tree.trunk.material = 0;
  tree.leaves.materials = std::vector<std::uint32_t>{k_none, 0};
  give_default_materials({}, tree);
  ASSERT_EQ(tree.materials.size(), 2u);
  EXPECT_EQ(tree.materials[0].diffuse, k_own);
  EXPECT_EQ(tree.trunk.material, 0u);
  EXPECT_EQ(tree.leaves.materials.to_vector(), (std::vector<std::uint32_t>{1, 0}));
}

TEST(DefaultMaterials, AnUndefinedMaterialLooksLikeWhatMostIsMadeOfIt) {
  Tree tree = bare();
  tree.materials = {
      {.name = "bark"}, {.name = "foliage"}, {.name = "unused"}, {.name = "own", .diffuse = k_own}};
  tree.trunk.materials = std::vector<std::uint32_t>{0, 3};
  tree.leaves.materials = std::vector<std::uint32_t>{1, 3};
  give_default_materials(std::vector<std::uint32_t>{0, 1, 2}, tree);
  EXPECT_EQ(tree.materials.size(), 4u);
  EXPECT_EQ(tree.materials[0].diffuse, k_wood_colour);
  EXPECT_EQ(tree.materials[1].diffuse, k_leaf_colour);
  EXPECT_EQ(tree.materials[2].diffuse, Material{}.diffuse);
  EXPECT_EQ(tree.materials[3].diffuse, k_own);
}

TEST(DefaultMaterials, OfAMaterialOfBothTheOneWithMoreTrianglesDecides) {
  Tree tree = bare();
  tree.materials = {{.name = "everything"}};
  tree.trunk.material = tree.leaves.material = 0;
  give_default_materials(std::vector<std::uint32_t>{0}, tree);
  EXPECT_EQ(tree.materials[0].diffuse, k_leaf_colour);
  tree.leaves = {};
  give_default_materials(std::vector<std::uint32_t>{0}, tree);
  EXPECT_EQ(tree.materials[0].diffuse, k_wood_colour);
}

TEST(DefaultMaterials, ATreeWithoutLeavesHasNoMaterialOfLeaves) {
  Tree tree = bare();
  tree.leaves = {};
  give_default_materials({}, tree);
  ASSERT_EQ(tree.materials.size(), 1u);
  EXPECT_EQ(tree.leaves.material, k_none);
}

}  // namespace
}  // namespace copse
