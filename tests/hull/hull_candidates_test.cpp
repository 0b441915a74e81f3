#include "lib/analysis/hull/hull_candidates.h"

#include "lib/analysis/hull/exact_hull.h"
#include "lib/analysis/hull/point_cloud.h"
#include "tests/volumes/point_sets.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace copse {
namespace {

std::vector<Double3> corners_of(const std::vector<Double3>& sorted) {
  std::vector<Double3> corners;
  for (const std::uint32_t i : exact_hull(sorted).vertices) corners.push_back(sorted[i]);
  return corners;
}

std::vector<std::pair<std::string, std::vector<Double3>>> large_sets() {
  std::vector<Double3> grid;
  for (int i = 0; i < 9261; ++i)
    grid.push_back({(i % 21 - 10) / 10., (i / 21 % 21 - 10) / 10., (i / 441 - 10) / 10.});
  return {{"box", random_cloud(1, 20000, {1, 1, 1})},
          {"plate", random_cloud(2, 20000, {1, 0.7, 1e-4})},
          {"tilted needle", turned(random_cloud(3, 20000, {1, 1e-3, 2e-3}), {1, 2, 3}, {0, 1, 1})},
          {"torus", torus(150, 100, 0.5, 0.125)},
          {"grid", grid},
          {"sphere", on_sphere(4, 6000)}};
}

TEST(HullCandidates, HoldEveryCornerAndFewOthers) {
  for (const auto& [name, points] : large_sets()) {
    const HullCandidates found = hull_candidates(points, 1'000'000);
    EXPECT_EQ(found.all, found.chosen) << name;
    EXPECT_TRUE(std::is_sorted(found.all.begin(), found.all.end(), lexicographically_less)) << name;
    if (name != "grid") {  // whose facets are full of points that may or may not be called corners
      EXPECT_EQ(corners_of(found.all), corners_of(distinct_points(points))) << name;
    }
    for (const Double3& p : points) {
      const bool corner = name == "grid" && std::abs(p.x) == 1 && std::abs(p.y) == 1 && std::abs(p.z) == 1;
      EXPECT_TRUE(!corner || std::find(found.all.begin(), found.all.end(), p) != found.all.end());
    }
    if (name == "box" || name == "plate" || name == "tilted needle") {
      EXPECT_LT(found.all.size(), points.size() / 3) << name;
    }
  }
}

TEST(HullCandidates, DoNotDependOnTheOrderOrOnRepetition) {
  for (auto [name, points] : large_sets()) {
    const HullCandidates found = hull_candidates(points, 500);
    Random random(1);
    random.shuffle(std::span(points));
    const HullCandidates other = hull_candidates(points, 500);
    EXPECT_EQ(other.all, found.all) << name;
    EXPECT_EQ(other.chosen, found.chosen) << name;
  }
}

TEST(HullCandidates, TooManyAreThinnedToTheLimit) {
  const auto sphere = on_sphere(4, 20000);
  const HullCandidates found = hull_candidates(sphere, 1000);
  EXPECT_EQ(found.all.size(), sphere.size());
  EXPECT_LE(found.chosen.size(), 1000u);
  EXPECT_GT(found.chosen.size(), 500u);
  for (const Double3& p : found.chosen) {
    EXPECT_TRUE(std::binary_search(found.all.begin(), found.all.end(), p, lexicographically_less));
  }
}

TEST(HullCandidates, OfFlatOrRepeatedPointsAreTheDistinctOnes) {
  std::vector<Double3> flat = random_cloud(5, 8000, {1, 1, 0});
  EXPECT_EQ(hull_candidates(flat, 10'000).all, distinct_points(flat));
  const std::vector<Double3> one(10'000, {.1, .2, .3});
  EXPECT_EQ(hull_candidates(one, 10'000).all.size(), 1u);
}

}  // namespace
}  // namespace copse
