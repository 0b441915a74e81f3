#include "lib/analysis/lod/leaf_twins.h"

#include "lib/analysis/lod/leaf_collapse.h"
#include "lib/analysis/measure/lod_quality.h"
#include "tests/lod/leafy_tree.h"

#include <algorithm>
#include <utility>

#include <gtest/gtest.h>

namespace copse {
namespace {

// Every card from its other side as well: with vertices of its own, or with the same.
Tree doubled(Tree tree, bool own_vertices) {
  std::vector<CornerTriangle> triangles;
  std::vector<Float3> vertices(tree.leaves.vertices.begin(), tree.leaves.vertices.end());
  const auto count = static_cast<std::uint32_t>(vertices.size());
  if (own_vertices) vertices.insert(vertices.end(), tree.leaves.vertices.begin(), tree.leaves.vertices.end());
  for (std::size_t card = 0; card < tree.leaves.triangles.size(); card += 2)
    for (const bool back : {false, true})
      for (std::size_t t = card; t < card + 2; ++t) {
        CornerTriangle c = tree.leaves.triangles[t];
        if (back) std::swap(c.vertex[0], c.vertex[1]), std::swap(c.texcoord[0], c.texcoord[1]);
        for (std::uint32_t& v : c.vertex) v += back && own_vertices ? count : 0;
        triangles.push_back(c);
      }
  tree.header.leaf_factor = 4;
  tree.leaves.triangles = std::move(triangles), tree.leaves.vertices = std::move(vertices);
  return tree;
}

std::uint32_t step_with(const Spectrum& s, std::size_t triangles) {
  std::uint32_t n = 0;
  while (n < s.steps() && s.counts[n] > triangles) ++n;
  return n;
}

TEST(LeafTwins, OfATriangleFromBothSidesOneIsLeft) {
  for (const bool own : {false, true}) {
    const LeafPieces pieces = leaf_pieces(doubled(LeafyTree{.leaves = 20}.make(), own));
    const auto twins = part_twins(pieces);
    ASSERT_TRUE(twins);
    EXPECT_EQ(twins->gone.size(), 40u);
    EXPECT_EQ(twins->left.triangles.size(), 40u);
    EXPECT_EQ(twins->left.part.triangles.size(), 40u);
    std::vector<std::uint32_t> numbers = twins->left.triangles;
    std::sort(numbers.begin(), numbers.end());
    for (std::uint32_t t = 0; t < 40; ++t) EXPECT_EQ(numbers[t], t);
    EXPECT_FALSE(part_twins(twins->left));
  }
}

TEST(LeafTwins, ACrownWithoutThemHasNone) {
  EXPECT_FALSE(part_twins(leaf_pieces(LeafyTree{.leaves = 50}.make())));
  EXPECT_FALSE(part_twins({}));
}

TEST(LeafTwins, TheyGoFirstAndNothingIsMissed) {
  const Tree tree = doubled(LeafyTree{.leaves = 300}.make(), true);
  for (const CollapseQuality quality : {CollapseQuality::fast, CollapseQuality::balanced}) {
    const Spectrum s = collapse_spectrum(tree, {}, {.quality = quality});
    EXPECT_EQ(s.counts[0], 1200u);
    const std::uint32_t half = step_with(s, 600);
    EXPECT_EQ(s.counts[half], 600u);
    const LodJudge judge(drawn_state(s, 0), {}, {.views = 6, .image_size = 64});
    EXPECT_EQ(judge.measure(drawn_state(s, half)).iou_low, 1);
    EXPECT_LE(s.errors[half], 0.001);
    for (std::uint32_t n = 1; n <= half; ++n) EXPECT_LT(s.counts[n], s.counts[n - 1]);
  }
}

TEST(LeafTwins, ACrownOfLeavesFromBothSidesCollapsesAsOneFromOneSide) {
  const Tree single = LeafyTree{.leaves = 2000, .half = 0.07}.make(), both = doubled(single, false);
  for (const CollapseQuality quality : {CollapseQuality::fast, CollapseQuality::balanced}) {
    const Spectrum a = collapse_spectrum(single, {}, {.quality = quality}),
                   b = collapse_spectrum(both, {}, {.quality = quality});
    for (const std::size_t triangles : {2000u, 400u, 80u}) {
      const DrawnMesh x = drawn_state(a, step_with(a, triangles)),
                      y = drawn_state(b, step_with(b, triangles));
      const LodJudge judge(x, {}, {.views = 6, .image_size = 64});
      EXPECT_NEAR(judge.measure(y).coverage_ratio, 1, 0.03) << triangles;
    }
  }
}

TEST(LeafTwins, OneOfATriangleOfAlphaIsNoCardAnyMore) {
  Tree tree = LeafyTree{.leaves = 1, .groups = 1, .alpha = true}.make();
  tree.leaves.triangles = std::vector<CornerTriangle>{tree.leaves.triangles[0], tree.leaves.triangles[0]};
  const auto twins = part_twins(leaf_pieces(tree));
  ASSERT_TRUE(twins);
  ASSERT_EQ(twins->left.list.size(), 1u);
  EXPECT_EQ(twins->left.list[0].cut, LeafCut::triangle);
}

}  // namespace
}  // namespace copse
