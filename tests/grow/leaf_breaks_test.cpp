// Each way to break the leaves does what its name says.
#include "tests/grow/mesh_facts.h"

#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>

namespace copse::grow {
namespace {

struct Form {
  const char* name;
  std::size_t triangles, components, vertices;
};

class LeafForms : public testing::TestWithParam<Form> {};

TEST_P(LeafForms, HaveTheTrianglesAndPiecesOfTheirName) {
  const Form form = GetParam();
  const Grown tree = small_tree("birch", form.name, 12000);
  const std::size_t leaves = tree.truth.leaf_centres.size();
  ASSERT_GT(leaves, 10u);
  const auto triangles = leaf_triangles(tree.mesh);
  EXPECT_EQ(triangles.size(), leaves * form.triangles);
  EXPECT_EQ(pieces(triangles), leaves * form.components);
  EXPECT_EQ(tree.truth.leaf_components, leaves * form.components);
  EXPECT_EQ(tree.truth.leaf_triangles, triangles.size());
  std::set<std::uint32_t> used;
  for (const Triangle& t : triangles) used.insert(t.begin(), t.end());
  EXPECT_EQ(used.size(), leaves * form.vertices);
}

INSTANTIATE_TEST_SUITE_P(Breaks, LeafForms,
                         testing::Values(Form{"none", 1, 1, 3}, Form{"quad-cards", 2, 1, 4},
                                         Form{"crossed-cards", 4, 2, 8}, Form{"bent-cards", 8, 1, 9},
                                         Form{"two-sided-cards", 4, 2, 8}, Form{"discs", 6, 1, 8},
                                         Form{"fronds", 24, 1, 21}, Form{"needles", 2, 1, 4},
                                         Form{"blobs", 80, 1, 42}),
                         [](const auto& test) {
                           std::string name = test.param.name;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

// Corner positions of each leaf, in the order of the truth: leaves follow one another in the mesh.
std::vector<std::vector<Double3>> leaf_points(const Grown& tree, std::size_t vertices) {
  std::uint32_t first = 0xffffffffu;
  for (const Triangle& t : leaf_triangles(tree.mesh)) first = std::min({first, t[0], t[1], t[2]});
  std::vector<std::vector<Double3>> result(tree.truth.leaf_centres.size());
  for (std::size_t l = 0; l < result.size(); ++l)
    for (std::size_t v = 0; v < vertices; ++v)
      result[l].push_back(tree.mesh.positions[first + l * vertices + v]);
  return result;
}

double off_plane(const std::vector<Double3>& p) {
  const Double3 n = normalized(cross(p[1] - p[0], p[2] - p[0]));
  double most = 0;
  for (const Double3& q : p) most = std::max(most, std::abs(dot(q - p[0], n)));
  return most / distance(p[0], p[2]);
}

TEST(LeafBreaks, TruthCentresAreTheMeansOfTheVertices) {
  const Grown tree = small_tree("willow", "bent-cards", 12000);
  const auto points = leaf_points(tree, 9);
  for (std::size_t l = 0; l < points.size(); ++l) {
    Double3 mean;
    for (const Double3& p : points[l]) mean += p / 9;
    EXPECT_LT(distance(mean, tree.truth.leaf_centres[l]), 1e-9 * tree.truth.height);
  }
}

TEST(LeafBreaks, CardsAndDiscsAreFlatAndBentCardsAndFrondsAreNot) {
  for (const auto& leaf : leaf_points(small_tree("birch", "discs", 12000), 8))
    EXPECT_LT(off_plane(leaf), 1e-4);
  for (const auto& leaf : leaf_points(small_tree("birch", "quad-cards", 12000), 4))
    EXPECT_LT(off_plane(leaf), 1e-4);
  for (const auto& leaf : leaf_points(small_tree("birch", "bent-cards", 12000), 9))
    EXPECT_GT(off_plane(leaf), 0.02);
  for (const auto& leaf : leaf_points(small_tree("birch", "fronds", 12000), 21))
    EXPECT_GT(off_plane(leaf), 0.02);
}

TEST(LeafBreaks, CrossedCardsCrossAtRightAnglesAndShareNoPosition) {
  const Grown tree = small_tree("birch", "crossed-cards", 12000);
  for (const auto& p : leaf_points(tree, 8)) {
    const Double3 a = normalized(cross(p[1] - p[0], p[2] - p[0])),
                  b = normalized(cross(p[5] - p[4], p[6] - p[4]));
    EXPECT_LT(std::abs(dot(a, b)), 0.01);
    EXPECT_LT(distance((p[0] + p[2]) / 2, (p[4] + p[6]) / 2), 1e-4);
    for (int i = 0; i < 4; ++i)
      for (int j = 4; j < 8; ++j) EXPECT_GT(distance(p[i], p[j]), 1e-3);
  }
}

TEST(LeafBreaks, TwoSidedCardsCoincideBackToBack) {
  for (const auto& p : leaf_points(small_tree("birch", "two-sided-cards", 12000), 8))
    for (int i = 0; i < 4; ++i) EXPECT_EQ(p[i], p[i + 4]);
}

TEST(LeafBreaks, NeedlesAreFourteenTimesAsLongAsWide) {
  for (const auto& p : leaf_points(small_tree("birch", "needles", 12000), 4))
    EXPECT_NEAR(distance(p[0], p[3]) / distance(p[0], p[1]), 14, 0.1);
}

TEST(LeafBreaks, BlobsAreClosedFaceOutwardAndHaveNoTexture) {
  const Grown tree = small_tree("birch", "blobs", 12000);
  const auto triangles = leaf_triangles(tree.mesh);
  EXPECT_EQ(open_edges(triangles), 0u);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    const auto& p = tree.mesh.positions;
    const Double3 out = p[a] - tree.truth.leaf_centres[t / 80];
    EXPECT_GT(dot(cross(p[b] - p[a], p[c] - p[a]), out), 0);
  }
}

TEST(LeafBreaks, TouchingLeavesAreFewerPiecesWhenWelded) {
  const Grown apart = small_tree("birch", "quad-cards"),
              touching = small_tree("birch", "quad-cards,touching-leaves");
  const auto welded_pieces = [](const Grown& tree) {
    return pieces(welded(tree.mesh, leaf_triangles(tree.mesh)).triangles);
  };
  const std::size_t leaves = touching.truth.leaf_centres.size();
  EXPECT_EQ(welded_pieces(apart), apart.truth.leaf_centres.size());
  EXPECT_LT(welded_pieces(touching), leaves * 3 / 4);
  EXPECT_GE(welded_pieces(touching), leaves / 2);
  EXPECT_EQ(pieces(leaf_triangles(touching.mesh)), leaves);
}

TEST(LeafBreaks, LeavesOnBarkShareAPlaceWithARingVertex) {
  const Grown tree = small_tree("birch", "quad-cards,leaves-on-bark");
  std::set<std::array<double, 3>> bark;
  for (const Triangle& t : trunk_triangles(tree.mesh))
    for (const std::uint32_t v : t)
      bark.insert({tree.mesh.positions[v].x, tree.mesh.positions[v].y, tree.mesh.positions[v].z});
  for (const auto& leaf : leaf_points(tree, 4))
    EXPECT_TRUE(std::any_of(leaf.begin(), leaf.end(), [&](const Double3& p) {
      return bark.count({p.x, p.y, p.z}) > 0;
    }));
}

TEST(LeafBreaks, GroupSpheresHoldTheirLeaves) {
  const Grown tree = small_tree("spruce", "fronds", 12000);
  const auto points = leaf_points(tree, 21);
  std::map<std::uint32_t, TruthLeafGroup> groups;
  std::size_t grouped = 0;
  for (const TruthLeafGroup& g : tree.truth.leaf_groups) {
    EXPECT_TRUE(groups.emplace(g.branch, g).second);
    grouped += g.leaves;
  }
  EXPECT_EQ(grouped, points.size());
  for (std::size_t l = 0; l < points.size(); ++l) {
    const TruthLeafGroup& g = groups.at(tree.truth.leaf_branch[l]);
    for (const Double3& p : points[l]) EXPECT_LE(distance(p, g.centre), g.radius);
  }
}

}  // namespace
}  // namespace copse::grow
