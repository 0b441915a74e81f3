#include "lib/formats/tree_file.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

Tree small_tree() {
  Tree tree;
  tree.header.kind = TreeKind::sensitive;
  tree.header.roots = 1;
  tree.header.ring_size = 2;
  tree.header.monotone = true;
  tree.provenance = "{}";
  tree.materials.resize(1);
  tree.materials[0].name = "bark";
  tree.hierarchy.radii = std::vector<Radius>{
      {.centre = {0, 0, 0}, .diameter = 2, .outer_radius = 1, .first_child = 1, .child_count = 1},
      {.centre = {0, 1, 0}, .diameter = 2, .outer_radius = 1, .distance = 1, .flags = Radius::terminal}};
  tree.hierarchy.vectors = std::vector<Float3>{{1, 0, 0}, {-1, 0, 0}, {1, 0, 0}, {-1, 0, 0}};
  tree.trunk.triangles = std::vector<CornerTriangle>{{.vertex = {0, 1, 2}}, {.vertex = {1, 3, 2}}};
  tree.header.segment_factor = 2;
  tree.trunk.lines = std::vector<std::array<std::uint32_t, 2>>{{0, 1}};
  tree.trunk.diameters = std::vector<float>{2};
  tree.trunk.accumulated_lengths = std::vector<double>{1};
  tree.trunk.material = 0;
  return tree;
}

TEST(TreeFile, LoadsWhatWasEncoded) {
  for (const Encoding encoding : {Encoding::raw, Encoding::zstd}) {
    const auto bytes = encode_tree(small_tree(), {.encoding = encoding});
    ASSERT_TRUE(bytes) << to_line(bytes.error(), "test");
    const auto file = TreeFile::from_bytes(*bytes, "small.stree");
    ASSERT_TRUE(file) << to_line(file.error(), "test");
    const auto tree = file->load();
    ASSERT_TRUE(tree) << to_line(tree.error(), "test");
    EXPECT_EQ(tree->header, small_tree().header);
    EXPECT_EQ(*encode_tree(*tree, {.encoding = encoding}), *bytes);
    EXPECT_EQ(tree->trunk.triangles.to_vector(), small_tree().trunk.triangles.to_vector());
  }
}

}  // namespace
}  // namespace copse
