#include "lib/analysis/leaves/leaf_geometry.h"

#include "tests/leaves/shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace copse {
namespace {

using testing::ElementsAre;

TEST(LeafGeometry, OfNoLeavesIsEmpty) {
  const LeafGeometry g = leaf_geometry(Mesh{}, {}, 0);
  EXPECT_EQ(g.count(), 0u);
  EXPECT_THAT(g.first, ElementsAre(0));
}

TEST(LeafGeometry, TheCentreOfATriangleIsTheMeanOfItsVertices) {
  shapes::Builder b;
  b.triangle({0, 0, 0}, {3, 0, 0}, {0, 6, 3});
  const LeafGeometry g = leaf_geometry(b.mesh, std::vector<std::uint32_t>{0}, 1);
  EXPECT_EQ(g.centres[0], (Double3{1, 2, 1}));
  EXPECT_DOUBLE_EQ(g.areas[0], length(cross(Double3{3, 0, 0}, Double3{0, 6, 3})) / 2);
}

TEST(LeafGeometry, APositionThatIsRepeatedCountsOnce) {
  shapes::Builder b;
  b.triangle({0, 0, 0}, {4, 0, 0}, {4, 4, 0});
  b.triangle({0, 0, 0}, {4, 4, 0}, {0, 4, 0});  // its own points: two of the diagonal are repeated
  const LeafGeometry g = leaf_geometry(b.mesh, std::vector<std::uint32_t>{0, 0}, 1);
  EXPECT_EQ(g.centres[0], (Double3{2, 2, 0}));
  EXPECT_DOUBLE_EQ(g.areas[0], 16);
}

TEST(LeafGeometry, ListsTrianglesLeafAfterLeafWithoutTheTrunk) {
  shapes::Builder b;
  for (int i = 0; i < 5; ++i) b.triangle({double(i), 0, 0}, {i + 1.0, 0, 0}, {double(i), 1, 0});
  const LeafGeometry g = leaf_geometry(b.mesh, std::vector<std::uint32_t>{0, k_none, 1, 0, 1}, 2);
  EXPECT_THAT(g.first, ElementsAre(0, 2, 4));
  EXPECT_THAT(g.triangles, ElementsAre(0, 3, 2, 4));
}

TEST(LeafGeometry, AreasCountTheAlphaCoverageOfTheFirstTrianglesMaterial) {
  shapes::Builder b;
  b.part("", b.material("leaf"));
  b.mesh.materials[0].alpha_coverage = 0.25f;
  b.card({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  b.part("");
  b.card({9, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const LeafGeometry g = leaf_geometry(b.mesh, std::vector<std::uint32_t>{0, 0, 1, 1}, 2);
  EXPECT_THAT(g.areas, ElementsAre(1, 4));
}

TEST(LeafGeometry, FarFromTheOriginCentresKeepTheirDigits) {
  shapes::Builder b;
  const Double3 far{1e7, -1e7, 1e7};
  b.card(far, {0.125, 0, 0}, {0, 0.125, 0});
  const LeafGeometry g = leaf_geometry(b.mesh, std::vector<std::uint32_t>{0, 0}, 1);
  EXPECT_EQ(g.centres[0], far);
}

}  // namespace
}  // namespace copse
