#include "lib/analysis/surface/reverse_subdivision.h"

#include "tests/trunk/welded_meshes.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

// A trunk of cells with two limbs: vertices of 3, 4 and 5 edges.
const std::vector<Cell> k_cells{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {1, 2, 0},
                                {2, 2, 0}, {0, 3, 0}, {0, 3, 1}, {0, 4, 0}};

double off_the_grid(const Double3& p) {
  return std::max(
      {std::abs(p.x - std::round(p.x)), std::abs(p.y - std::round(p.y)), std::abs(p.z - std::round(p.z))});
}

void expect_cells(const Cage& cage, std::uint32_t levels, double precision) {
  EXPECT_EQ(cage.levels, levels);
  EXPECT_FALSE(cage.is_on_limit);
  EXPECT_LE(cage.precision, precision);
  EXPECT_EQ(cage.faces.count(), 34u);  // eight cubes of six, less two at each of seven joints
  EXPECT_EQ(cage.positions.size(), 36u);
  for (std::size_t f = 0; f < cage.faces.count(); ++f) EXPECT_EQ(cage.faces[f].size(), 4u);
  for (const Double3& p : cage.positions) EXPECT_LE(off_the_grid(p), precision);
}

TEST(ReverseSubdivision, FindsTheCellsThatWereSmoothed) {
  for (const int rounds : {1, 2, 3}) {
    const Surface s = surface_of(smooth_cells(k_cells, rounds));
    const auto cage = reverse_subdivision(s);
    ASSERT_TRUE(cage) << rounds;
    expect_cells(*cage, static_cast<std::uint32_t>(rounds), 1e-7);
    ASSERT_EQ(cage->face_of.size(), s.triangles.size());
    std::vector<std::uint32_t> triangles(cage->faces.count(), 0);
    for (const std::uint32_t f : cage->face_of) ++triangles.at(f);
    for (const std::uint32_t n : triangles) EXPECT_EQ(n, 2u << (2 * rounds));
  }
}

// One step over a column of cells, in which the square at each of `heights` was kept: its corners where they
// are, its sides straight (`straight`) or smooth.
Surface with_kept_squares(const std::vector<int>& heights, bool straight) {
  std::vector<Cell> column;
  for (int y = 0; y < 60; ++y) column.push_back({0, y, 0});
  Surface s = surface_of(smooth_cells(column, 1));
  for (Double3& p : s.positions) {
    if (std::ranges::none_of(heights, [&](int y) { return std::abs(p.y - y) < 1e-9; })) continue;
    const auto kept = [](double x) { return std::abs(x - 0.5) < 1e-9 ? x : std::round(x); };
    const bool is_corner = std::abs(p.x - 0.5) > 1e-9 && std::abs(p.z - 0.5) > 1e-9;
    if (is_corner || straight) p = {kept(p.x), p.y, kept(p.z)};
  }
  return s;
}

TEST(ReverseSubdivision, FindsCornersThatWereKeptWhereTheyAreAndSidesThatWereKeptStraight) {
  for (const bool straight : {false, true}) {
    for (const std::vector<int>& heights : {std::vector<int>{30}, {12, 13}, {20, 40, 43}}) {
      const auto cage = reverse_subdivision(with_kept_squares(heights, straight));
      ASSERT_TRUE(cage);
      EXPECT_EQ(cage->faces.count(), 242u);
      for (const Double3& p : cage->positions) EXPECT_LE(off_the_grid(p), 1e-6) << p.y << ' ' << straight;
    }
  }
}

TEST(ReverseSubdivision, ForgivesTheRoundingOfAFile) {
  Surface s = surface_of(smooth_cells(k_cells, 2));
  for (Double3& p : s.positions)
    p = {std::round(p.x * 1e6) / 1e6, std::round(p.y * 1e6) / 1e6, std::round(p.z * 1e6) / 1e6};
  const auto cage = reverse_subdivision(s);
  ASSERT_TRUE(cage);
  expect_cells(*cage, 2, 1e-4);
}

TEST(ReverseSubdivision, WorksFarFromTheOrigin) {
  Surface s = surface_of(smooth_cells(k_cells, 1));
  for (Double3& p : s.positions) p += Double3{1e5, 0, -2e5};
  const auto cage = reverse_subdivision(s);
  ASSERT_TRUE(cage);
  expect_cells(*cage, 1, 1e-6);
}

TEST(ReverseSubdivision, RefusesWhatWasNotSubdivided) {
  // The right connectivity in the wrong places: each vertex moved by a hundredth of an edge.
  Surface moved = surface_of(smooth_cells(k_cells, 2));
  std::uint32_t state = 1;
  for (Double3& p : moved.positions) {
    state = state * 1664525u + 1013904223u;
    p.x += 1e-3 * static_cast<double>(state >> 16) / 65536.0;
  }
  EXPECT_FALSE(reverse_subdivision(moved));
  // Quads round a circle whose every second ring and side could be an edge point.
  const std::vector<double> radii(33, 0.5);
  std::vector<Double3> axis;
  for (int i = 0; i < 33; ++i) axis.push_back({0, 0.3 * i, 0});
  EXPECT_FALSE(reverse_subdivision(surface_of(tube(axis, radii, 16, false))));
  // No quads, odd rings, nothing.
  EXPECT_FALSE(reverse_subdivision(surface_of(sphere(9, 7, 1))));
  EXPECT_FALSE(reverse_subdivision(surface_of(torus(15, 7, 3, 1))));
  EXPECT_FALSE(reverse_subdivision(surface_of(moebius(64))));
  EXPECT_FALSE(reverse_subdivision(surface_of(random_soup(60, 400, 3))));
  EXPECT_FALSE(reverse_subdivision({}));
}

}  // namespace
}  // namespace copse
