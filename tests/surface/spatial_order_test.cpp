#include "lib/analysis/surface/spatial_order.h"

#include "lib/analysis/surface/tolerances.h"
#include "lib/formats/random.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>

namespace copse {
namespace {

using Ids = std::vector<std::uint32_t>;

Ids in_order(std::size_t n) {
  Ids ids(n);
  std::iota(ids.begin(), ids.end(), 0u);
  return ids;
}

// A spiral of points: each near the one before.
std::vector<Double3> spiral(std::size_t n) {
  std::vector<Double3> p;
  for (std::size_t i = 0; i < n; ++i) {
    const double a = 40 * static_cast<double>(i) / static_cast<double>(n);
    p.push_back({a * std::cos(a), 2 * a, a * std::sin(a)});
  }
  return p;
}

Ids shuffled(std::size_t n) {
  Ids ids = in_order(n);
  Random(7).shuffle(std::span(ids));
  return ids;
}

double mean_step(const std::vector<Double3>& p, const Ids& at) {
  double way = 0;
  for (std::size_t i = 1; i < at.size(); ++i) way += distance(p[at[i - 1]], p[at[i]]);
  return way / static_cast<double>(at.size());
}

TEST(SpatialOrder, TellsWhatIsScatteredFromWhatIsInOrder) {
  const std::size_t n = 2 * k_least_scattered;
  const std::vector<Double3> p = spiral(n);
  EXPECT_FALSE(is_scattered(p, in_order(n)));
  EXPECT_TRUE(is_scattered(p, shuffled(n)));
}

TEST(SpatialOrder, CallsNothingScatteredThatFitsIntoACacheOrHasNoExtent) {
  const std::vector<Double3> p = spiral(k_least_scattered - 1);
  EXPECT_FALSE(is_scattered(p, shuffled(p.size())));
  EXPECT_FALSE(is_scattered(std::vector<Double3>(2 * k_least_scattered), in_order(2 * k_least_scattered)));
  EXPECT_FALSE(is_scattered({}, {}));
}

TEST(SpatialOrder, BringsNeighboursTogetherAndKeepsEveryOne) {
  const std::size_t n = 2 * k_least_scattered;
  const std::vector<Double3> p = spiral(n);
  const Ids at = shuffled(n);
  const Ids order = spatial_order(p, at);
  Ids sorted = order, there;
  std::ranges::sort(sorted);
  EXPECT_EQ(sorted, in_order(n));
  for (const std::uint32_t i : order) there.push_back(at[i]);
  EXPECT_LT(mean_step(p, there), mean_step(p, at) / 8);
  EXPECT_FALSE(is_scattered(p, there));
}

TEST(SpatialOrder, KeepsTheOrderWithinACell) {
  const std::vector<Double3> p{{0, 0, 0}, {1, 1, 1}, {1e-3, 0, 0}, {1, 1, 0.999}, {0, 1e-3, 0}};
  EXPECT_EQ(spatial_order(p, in_order(p.size())), (Ids{0, 2, 4, 1, 3}));
}

TEST(SpatialOrder, HandlesOnePlaceAndNumbersWithoutADifference) {
  EXPECT_TRUE(spatial_order({}, {}).empty());
  EXPECT_EQ(spatial_order(std::vector<Double3>(3, {7, 7, 7}), in_order(3)), in_order(3));
  const double huge = std::numeric_limits<double>::max(), none = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Double3> p{{huge, 0, 0}, {-huge, 0, 0}, {none, none, none}};
  EXPECT_EQ(spatial_order(p, in_order(3)).size(), 3u);
}

// A band of triangles along the spiral, with normals of its own and no texture coordinates.
Mesh strip(std::size_t n) {
  Mesh mesh;
  mesh.positions = spiral(n);
  for (std::uint32_t i = 0; i < n; ++i) mesh.normals.push_back({static_cast<float>(i), 0, 0});
  for (std::uint32_t i = 0; i + 2 < n; ++i) {
    mesh.triangles.push_back({i, i + 1, i + 2});
    mesh.normal_triangles.push_back({i, k_none, i + 2});
    mesh.part_of.push_back(i % 3);
    mesh.face_of.push_back(i);
  }
  mesh.positions.push_back({0, 99, 0});  // which no triangle uses
  return mesh;
}

TEST(SpatialOrder, LeavesAMeshAloneThatIsInOrder) {
  Mesh mesh = strip(2 * k_least_scattered);
  const Mesh before = mesh;
  EXPECT_TRUE(order_by_place(mesh).empty());
  EXPECT_EQ(mesh.triangles, before.triangles);
  EXPECT_EQ(mesh.positions, before.positions);
}

TEST(SpatialOrder, BringsAScatteredMeshTogetherAndKeepsEveryCorner) {
  Mesh mesh = strip(2 * k_least_scattered);
  const Mesh sorted = mesh;
  const Ids at = shuffled(mesh.triangles.size());
  for (std::size_t t = 0; t < at.size(); ++t) {
    mesh.triangles[t] = sorted.triangles[at[t]];
    mesh.normal_triangles[t] = sorted.normal_triangles[at[t]];
    mesh.part_of[t] = sorted.part_of[at[t]];
    mesh.face_of[t] = sorted.face_of[at[t]];
  }
  const Mesh before = mesh;
  const Ids place = order_by_place(mesh);
  ASSERT_EQ(place.size(), before.triangles.size());
  EXPECT_EQ(bounds(mesh).max, bounds(before).max);
  std::uint32_t first_use = 0;
  for (std::size_t t = 0; t < place.size(); ++t) {
    ASSERT_EQ(mesh.part_of[t], before.part_of[place[t]]);
    ASSERT_EQ(mesh.face_of[t], before.face_of[place[t]]);
    for (std::size_t c = 0; c < 3; ++c) {
      ASSERT_EQ(mesh.positions[mesh.triangles[t][c]], before.positions[before.triangles[place[t]][c]]);
      ASSERT_LE(mesh.triangles[t][c], first_use);
      if (mesh.triangles[t][c] == first_use) ++first_use;
      const std::uint32_t n = mesh.normal_triangles[t][c], old = before.normal_triangles[place[t]][c];
      ASSERT_EQ(n == k_none, old == k_none);
      if (n == k_none) continue;
      ASSERT_EQ(mesh.normals[n], before.normals[old]);
    }
  }
  EXPECT_FALSE(is_scattered(mesh.positions, [&] {
    Ids first;
    for (const Triangle& t : mesh.triangles) first.push_back(t[0]);
    return first;
  }()));
}

}  // namespace
}  // namespace copse
