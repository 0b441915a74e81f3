#include "lib/analysis/tree/assemble.h"

#include "lib/formats/tree/check_tree.h"
#include "lib/formats/tree_file/tree_file.h"
#include "tests/tree/tube_fixture.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

// A forked tube with two leaves of two triangles at the tips.
struct Model {
  Tube tube = forked_tube();
  std::vector<std::uint32_t> leaf_of;
  std::vector<Double3> centres{{0, 9, 0.5}, {7, 6, 0.5}};
  TreeGroups groups;

  Model() {
    const std::size_t trunk_triangles = tube.mesh.triangles.size();
    tube.mesh.materials.resize(2);
    tube.mesh.parts = {{"", "", 0}, {"", "", 1}};
    leaf_of.assign(trunk_triangles, k_none);
    for (std::uint32_t leaf = 0; leaf < 2; ++leaf) {
      const auto v = static_cast<std::uint32_t>(tube.mesh.positions.size());
      for (const Double3& d : {Double3{-1, 0, -.5}, {1, 0, -.5}, {1, 0, .5}, {-1, 0, .5}}) {
        tube.mesh.positions.push_back(centres[leaf] + d);
      }
      for (const Triangle& t : {Triangle{v, v + 1, v + 2}, Triangle{v, v + 2, v + 3}}) {
        tube.mesh.triangles.push_back(t);
        tube.mesh.part_of.push_back(1);
        leaf_of.push_back(leaf);
      }
    }
    groups.groups = {{to_float(centres[0]), 1.2f, 2, 0, 1}, {to_float(centres[1]), 1.2f, 2, 1, 1}};
    groups.order = {0, 1};
    groups.group_of_radius = {k_none, k_none, 0, k_none, 1};
  }
  Assembled assemble_as(TreeKind kind, const Double3& origin = {}) const {
    return assemble(
        {tube.mesh, tube.trunk, tube.hierarchy, leaf_geometry(tube.mesh, leaf_of, 2), groups, origin},
        {.kind = kind});
  }
};

TEST(Assemble, MakesASoundTreeOfBothKinds) {
  const Model model;
  for (const TreeKind kind : {TreeKind::still, TreeKind::sensitive}) {
    const Tree tree = model.assemble_as(kind).tree;
    EXPECT_EQ(check_tree(tree), std::vector<std::string>{});
    EXPECT_EQ(tree.segment_count(), 4u);
    EXPECT_EQ(tree.leaf_count(), 2u);
    EXPECT_FLOAT_EQ(tree.header.mean_leaf_area, 2);
    EXPECT_EQ(tree.trunk.material, 0u);
    EXPECT_EQ(tree.leaves.material, 1u);
  }
}

TEST(Assemble, SurvivesAFile) {
  const Tree tree = Model().assemble_as(TreeKind::sensitive).tree;
  const auto bytes = encode_tree(tree);
  ASSERT_TRUE(bytes) << bytes.error().what;
  const auto file = TreeFile::from_bytes(*bytes, "x.stree");
  ASSERT_TRUE(file) << file.error().what;
  const auto loaded = file->load();
  ASSERT_TRUE(loaded) << loaded.error().what;
  EXPECT_EQ(loaded->header, tree.header);
  EXPECT_EQ(trunk_vertices(*loaded), trunk_vertices(tree));
}

TEST(Assemble, KeepsNearTreesWhereTheyAre) {
  EXPECT_EQ(choose_origin({{-3, -1, -3}, {3, 12, 3}}), Double3{});
  EXPECT_EQ(choose_origin({}), Double3{});
  EXPECT_EQ(choose_origin({{-3e30, -1, -3}, {3e30, 12, 3}}), Double3{});
}

TEST(Assemble, MovesTheOriginOfFarTrees) {
  const Double3 origin = choose_origin({{1e7 - 3, 50, -2e7 - 3}, {1e7 + 3, 62, -2e7 + 3}});
  EXPECT_EQ(origin, (Double3{1e7, 50, -2e7}));
  const DoubleBox tiny{{1 - 1e-9, 1, 1}, {1 + 1e-9, 1 + 1e-9, 1}};
  EXPECT_LT(distance(choose_origin(tiny), tiny.centre()), 1e-8);
}

}  // namespace
}  // namespace copse
