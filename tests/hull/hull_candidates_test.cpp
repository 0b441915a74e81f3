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
    const Points found = hull_candidates(points);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end(), lexicographically_less)) << name;
    if (name != "grid") {  // whose facets are full of points that may or may not be called corners
      EXPECT_EQ(corners_of(found), corners_of(distinct_points(points))) << name;
    }
    for (const Double3& p : points) {
      const bool corner = name == "grid" && std::abs(p.x) == 1 && std::abs(p.y) == 1 && std::abs(p.z) == 1;
      EXPECT_TRUE(!corner || std::find(found.begin(), found.end(), p) != found.end());
    }
    if (name == "box" || name == "plate" || name == "tilted needle") {
      EXPECT_LT(found.size(), points.size() / 3) << name;
    }
  }
}

TEST(HullCandidates, DoNotDependOnTheOrder) {
  for (auto [name, points] : large_sets()) {
    const Points found = hull_candidates(points);
    Random random(1);
    random.shuffle(std::span(points));
    EXPECT_EQ(hull_candidates(points), found) << name;
  }
}

Points with(Points points, const Points& more) {
  points.insert(points.end(), more.begin(), more.end());
  return points;
}

// What a sample of a thousand misses may be all that makes a cloud thick.
TEST(HullCandidates, OneMastOnFlatGroundIsSeen) {
  const Points rough = random_cloud(2, 20'000, {1, 1, 1e-7}), blob = random_cloud(4, 20'000, {1, 1, 1}),
               line = random_cloud(3, 20'000, {1, 0, 0}), ten = random_cloud(5, 10, {1, 1, 1});
  const std::vector<NamedPoints> sets{
      {"ground and a mast", with(rough, {{.1, .2, .5}})},
      {"tilted", turned(with(rough, {{.1, .2, .5}}), {1, 2, 3}, {0, 1, 1})},
      {"flat ground and ten", with(random_cloud(1, 20'000, {1, 1, 0}), ten)},
      {"line and ten", with(line, ten)},
      {"a far point", with(blob, {{1e7, 1e7, 0}})},
      {"few far ones", with(blob, random_cloud(6, 30, {1, 1, 1}, {1e6, 1e5, 0}))},
  };
  for (const auto& [name, points] : sets) {
    const Points in_cloud = make_point_cloud(points).value().points;
    const Points found = hull_candidates(in_cloud);
    EXPECT_LT(found.size(), points.size() / 2) << name;
    EXPECT_EQ(corners_of(found), corners_of(distinct_points(in_cloud))) << name;
  }
}

TEST(HullCandidates, OfFlatOrRepeatedPointsAreTheDistinctOnes) {
  std::vector<Double3> flat = random_cloud(5, 8000, {1, 1, 0});
  EXPECT_EQ(hull_candidates(flat), distinct_points(flat));
  std::vector<Double3> one(10'000, {.1, .2, .3});
  EXPECT_EQ(hull_candidates(one).size(), 1u);
  one.insert(one.end(), {{.1, .2, .4}, {.1, .3, .3}, {.2, .2, .3}});
  EXPECT_EQ(hull_candidates(one).size(), 4u);
}

}  // namespace
}  // namespace copse
