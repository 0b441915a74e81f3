#include "lib/analysis/measure/lod_quality.h"

#include "tests/measure/shapes_to_draw.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace copse {
namespace {

DrawnMesh cube(const Double3& c, double h) {
  DrawnMesh m;
  for (int i = 0; i < 8; ++i)
    m.positions.push_back({c.x + (i & 1 ? h : -h), c.y + (i & 2 ? h : -h), c.z + (i & 4 ? h : -h)});
  m.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                 {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  m.material.assign(12, k_none);
  return m;
}

TEST(LodQuality, OfTheSourceItselfIsPerfect) {
  const DrawnMesh source = cube({}, 1);
  const LodQuality q = LodJudge(source, {}).measure(source);
  EXPECT_EQ(q.area_ratio, 1);
  EXPECT_EQ(q.coverage_ratio, 1);
  EXPECT_EQ(q.iou, 1);
  EXPECT_EQ(q.rmse, 0);
  EXPECT_NEAR(q.ssim, 1, 1e-9);
  EXPECT_EQ(q.hull_growth, 0);
}

TEST(LodQuality, TheImageErrorAloneIsTheSame) {
  const LodJudge judge(cube({}, 1), {});
  EXPECT_EQ(judge.rmse(cube({}, 0.9)), judge.measure(cube({}, 0.9)).rmse);
}

TEST(LodQuality, OfNothingIsNothing) {
  const LodQuality q = LodJudge(cube({}, 1), {}).measure({});
  EXPECT_EQ(q.area_ratio, 0);
  EXPECT_EQ(q.coverage_ratio, 0);
  EXPECT_EQ(q.iou, 0);
  EXPECT_GT(q.rmse, 0.05);
  EXPECT_EQ(q.hull_growth, 0);
}

TEST(LodQuality, SeesAConvexBodyScaled) {
  const double k = 1.05;
  const LodQuality q = LodJudge(cube({}, 1), {}, {.mask_size = 512}).measure(cube({}, k));
  EXPECT_NEAR(q.area_ratio, k * k, 1e-9);
  EXPECT_NEAR(q.coverage_ratio, k * k, 0.004);
  EXPECT_NEAR(q.iou, 1 / (k * k), 0.004);
  // supports grow by 5 % of the half diagonal at most; the directions miss the corner by a little
  EXPECT_NEAR(q.hull_growth, 0.025, 0.0005);
}

TEST(LodQuality, DoubledTrianglesAddAreaButNoCoverage) {
  const DrawnMesh source = cube({}, 1);
  DrawnMesh doubled = source;
  append(doubled, source);
  const LodQuality q = LodJudge(source, {}).measure(doubled);
  EXPECT_EQ(q.area_ratio, 2);
  EXPECT_EQ(q.coverage_ratio, 1);
  EXPECT_EQ(q.rmse, 0);
}

TEST(LodQuality, ASheetThatIsHalvedLosesHalfOfEverything) {
  const DrawnMesh source = square({}, 1);
  DrawnMesh half = source;
  half.triangles.pop_back(), half.material.pop_back();
  const LodQuality q = LodJudge(source, {}).measure(half);
  EXPECT_DOUBLE_EQ(q.area_ratio, 0.5);
  EXPECT_NEAR(q.coverage_ratio, 0.5, 0.01);
  EXPECT_NEAR(q.iou, 0.5, 0.02);
}

TEST(LodQuality, DoesNotDependOnTheNumberOfThreads) {
  const DrawnMesh source = cube({}, 1), level = cube({0.1, 0, 0}, 0.9);
  const LodQuality many = LodJudge(source, {}).measure(level);
  tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const LodQuality single = LodJudge(source, {}).measure(level);
  EXPECT_EQ(many.rmse, single.rmse);
  EXPECT_EQ(many.ssim, single.ssim);
  EXPECT_EQ(many.iou, single.iou);
}

TEST(LodQuality, OfASourceWithoutTrianglesIsDefined) {
  const LodQuality q = LodJudge({}, {}).measure({});
  EXPECT_EQ(q.area_ratio, 1);
  EXPECT_EQ(q.coverage_ratio, 1);
  EXPECT_EQ(q.iou, 1);
}

}  // namespace
}  // namespace copse
