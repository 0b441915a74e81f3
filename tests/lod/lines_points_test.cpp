#include "lib/analysis/lod/lines_points.h"

#include "lib/analysis/measure/view_sphere.h"
#include "tests/lod/leafy_tree.h"
#include "tests/lod/tube_tree.h"

#include <numbers>

#include <gtest/gtest.h>

namespace copse {
namespace {

// Leaves of one group, with the areas and bounds that a real file would have.
Tree leafy(bool alpha = false) {
  const LeafyTree maker{.leaves = 2000, .groups = 1, .alpha = alpha};
  Tree tree = maker.make();
  auto groups = tree.leaves.groups.to_vector();
  groups[0].mean_area = static_cast<float>(4 * maker.half * maker.half * (alpha ? 0.5 : 1));
  tree.leaves.groups = groups;
  for (const Float3& v : tree.leaves.vertices) tree.header.bounds.grow(v);
  return tree;
}

Tree lines(const std::vector<Double3>& directions) {
  Tree tree;
  tree.header.kind = TreeKind::still;
  std::vector<Float3> points;
  std::vector<std::array<std::uint32_t, 2>> lines;
  for (const Double3& d : directions) {
    lines.push_back(
        {static_cast<std::uint32_t>(points.size()), static_cast<std::uint32_t>(points.size() + 1)});
    points.push_back(to_float(-d * 0.5)), points.push_back(to_float(d * 0.5));
  }
  tree.trunk.line_vertices = points, tree.trunk.lines = lines;
  return tree;
}

constexpr double k_far = 1000;

double length_of(const std::vector<Double3>& directions, Orientation factor) {
  const ProjectionEstimate e(lines(directions));
  return e.at({{0, 0, k_far}, {0, 0, 1}}, {.orientation = factor}).length * k_far;
}

TEST(LinesPoints, LeafAreaIsWithinFifteenPercentFromEverywhereAtAnyCoverage) {
  for (const bool alpha : {false, true}) {
    for (const double coverage : {1.0, 0.5, 0.1}) {
      const ProjectionErrors e = projection_errors(leafy(alpha), coverage, view_sphere(1).directions);
      EXPECT_LT(e.largest.leaf_area, 0.15) << coverage;
      EXPECT_LT(e.mean.leaf_area, 0.07)
          << coverage << ": all leaves are one group, whose depth is its middle's";
    }
  }
}

TEST(LinesPoints, ALineAlongTheViewHasNoLengthAndOneAcrossHasAll) {
  const std::vector<Double3> along{{0, 0, 1}}, across{{1, 0, 0}};
  EXPECT_NEAR(length_of(along, Orientation::tensor), 0, 1e-6) << "the sine";
  EXPECT_NEAR(length_of(across, Orientation::tensor), 1, 1e-6);
  EXPECT_NEAR(length_of(along, Orientation::seed), 1, 1e-6) << "as printed";
  EXPECT_NEAR(length_of(across, Orientation::seed), 0, 1e-6);
}

TEST(LinesPoints, LinesOfAllDirectionsHaveAQuarterOfPiOfTheirLength) {
  const auto directions = view_sphere(3).directions;
  const double pi4 = std::numbers::pi / 4 * static_cast<double>(directions.size());
  EXPECT_NEAR(length_of(directions, Orientation::isotropic) / pi4, 1, 1e-3);
  EXPECT_NEAR(length_of(directions, Orientation::tensor) / pi4, 1, 1e-3);
  EXPECT_NEAR(true_projection(lines(directions), {{0, 0, k_far}, {0, 0, 1}}).length * k_far / pi4, 1, 0.01);
}

TEST(LinesPoints, AStemHasAQuarterOfItsSurfaceOnAverage) {
  const Tree tree = stem_with_twigs(10, 12, 0);
  double sum = 0;
  const auto directions = view_sphere(2).directions;
  const Double3 middle{0, 4.5, 0};
  for (const Double3& d : directions)
    sum += true_projection(tree, {middle + d * k_far, d}).trunk_area * k_far * k_far;
  // An open tube: its two ends are missing from Cauchy's convex body, its inside is counted like its outside.
  const double surface = 12 * 2 * 0.5 * std::sin(std::numbers::pi / 12) * 9;
  EXPECT_NEAR(sum / static_cast<double>(directions.size()), surface / 4, 0.02 * surface);
}

TEST(LinesPoints, LeavesThatAllFaceOneWayAreSeenThatWay) {
  const LeafyTree maker{.leaves = 1, .groups = 1};
  std::vector<Float3> vertices;
  std::vector<CornerTriangle> triangles;
  LeafyTree::add_card({}, {1, 0, 0}, {0, 1, 0}, vertices, triangles);
  Tree tree;
  maker.finish(tree, vertices, triangles, {{0, 0, 0}});
  auto groups = tree.leaves.groups.to_vector();
  groups[0].mean_area = 4;
  tree.leaves.groups = groups;
  const ProjectionEstimate e(tree);
  const double square = k_far * k_far;
  EXPECT_NEAR(e.at({{0, 0, k_far}, {0, 0, 1}}).leaf_area * square, 4, 1e-6);
  EXPECT_NEAR(e.at({{k_far, 0, 0}, {1, 0, 0}}).leaf_area * square, 0, 1e-6);
  EXPECT_NEAR(e.at({{0, 0, k_far}, {0, 0, 1}}, {.orientation = Orientation::isotropic}).leaf_area * square, 2,
              1e-6);
}

TEST(LinesPoints, AnEyeInsideTheTreeGetsANumber) {
  const Tree tree = leafy();
  const Projection p = ProjectionEstimate(tree).at({{0, 0, 0}, {0, 0, 1}});
  EXPECT_TRUE(std::isfinite(p.leaf_area));
  EXPECT_GT(p.leaf_area, 0);
}

TEST(LinesPoints, OfNothingIsNothing) {
  const Projection p = ProjectionEstimate(Tree{}).at({{0, 0, 5}, {0, 0, 1}});
  EXPECT_EQ(p.leaf_area, 0);
  EXPECT_EQ(p.trunk_area, 0);
  EXPECT_EQ(p.length, 0);
}

}  // namespace
}  // namespace copse
