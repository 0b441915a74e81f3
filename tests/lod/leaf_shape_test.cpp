#include "lib/analysis/lod/leaf_shape.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

// A square of side 2 in the plane z = 0 round the origin.
Patch flat_square() {
  Patch p = patch_of({{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}}}, 1, 1);
  p += patch_of({{{-1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}}, 1, 1);
  p.up = Double3{0, 1, 0} * p.area;
  return p;
}

double triangle_area(const LeafShape& s) {
  return 0.5 * length(cross(s.corners[1] - s.corners[0], s.corners[2] - s.corners[0]));
}

TEST(LeafShape, KeepsAreaCentreAndPlane) {
  const Patch p = flat_square();
  const LeafShape s = leaf_shape(p, nullptr, {10, 0, 0}, {});
  EXPECT_NEAR(triangle_area(s), 4, 1e-9);
  EXPECT_NEAR(distance((s.corners[0] + s.corners[1] + s.corners[2]) / 3, {10, 0, 0}), 0, 1e-9);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(s.corners[c].z, 0, 1e-9);
  EXPECT_NEAR(std::abs(s.normal.z), 1, 1e-9);
  EXPECT_NEAR(s.displacement, 0, 1e-6);
}

TEST(LeafShape, ACardOfACardIsThatCardWithItsTextureUpright) {
  const LeafShape s = leaf_shape(flat_square(), nullptr, {}, {.card = true, .textured = true});
  const double area = 2 * triangle_area(s);
  EXPECT_NEAR(area, 4, 1e-9);
  EXPECT_GT((s.corners[3] - s.corners[0]).y, 1) << "from corner 0 to corner 3 the texture grows";
  EXPECT_NEAR(distance(s.corners[0] + s.corners[2], s.corners[1] + s.corners[3]), 0, 1e-9)
      << "a parallelogram";
}

TEST(LeafShape, IsAsMuchLongerAsItsLeavesAreSpread) {
  Patch p;
  for (const double x : {-4.0, 0.0, 4.0}) {
    p += patch_of({{{x - 1, -1, 0}, {x + 1, -1, 0}, {x + 1, 1, 0}}}, 1, 1);
    p += patch_of({{{x - 1, -1, 0}, {x + 1, 1, 0}, {x - 1, 1, 0}}}, 1, 1);
  }
  const LeafShape s = leaf_shape(p, nullptr, {}, {.card = true});
  DoubleBox box;
  for (const Double3& c : s.corners) box.grow(c);
  EXPECT_NEAR(box.extent().x / box.extent().y, 3, 1e-6) << "the slimmest that is allowed";
}

TEST(LeafShape, OfWhatHasNoAreaIsAPoint) {
  const LeafShape s = leaf_shape({}, nullptr, {1, 2, 3}, {});
  for (const Double3& c : s.corners) EXPECT_TRUE(is_finite(c));
  EXPECT_NEAR(triangle_area(s), 0, 1e-12);
  EXPECT_TRUE(is_finite(s.normal));
}

TEST(LeafShape, IsCutToTheLargestArea) {
  EXPECT_NEAR(triangle_area(leaf_shape(flat_square(), nullptr, {}, {.largest = 1})), 1, 1e-9);
}

TEST(LeafShape, DoesNotReachOutOfAThinSheetOfLeaves) {
  // A disc of crossed leaves: their spread says horizontal; their facing does not.
  std::vector<FoliageTriangle> triangles;
  Patch all;
  for (int i = -10; i <= 10; ++i) {
    for (int j = -10; j <= 10; ++j) {
      const Double3 c{i * 0.1, 0, j * 0.1};
      const Double3 u = (i + j) % 2 ? Double3{0.05, 0, 0} : Double3{0, 0, 0.05}, v{0, 0.05, 0};
      triangles.push_back({{c - u - v, c + u - v, c + u + v}, 1});
      triangles.push_back({{c - u - v, c + u + v, c - u + v}, 1});
    }
  }
  const CrownField field(triangles, 24);
  for (const FoliageTriangle& t : triangles) {
    Patch p = patch_of(t.corners, 1, 1);
    p.open = p.area * field.at(t.corners[0]).openness;
    all += p;
  }
  const LeafShape s = leaf_shape(all, &field, {}, {});
  EXPECT_NEAR(triangle_area(s), 4.41, 0.01);
  for (int c = 0; c < 3; ++c) EXPECT_LT(std::abs(s.corners[c].y), 0.2);
  EXPECT_GT(std::abs(s.normal.y), 0.95);
}

}  // namespace
}  // namespace copse
