#include "lib/runtime/foliage_levels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

namespace copse {
namespace {

// Four cells in a row along x, seen from the six directions of an octahedron; cell c is seen by 0.25 (c + 1).
FoliageCells four_cells() {
  FoliageCells f;
  std::vector<FoliageCell> cells;
  for (std::uint32_t c = 0; c < 4; ++c) {
    FoliageCell cell;
    cell.box.centre = {static_cast<float>(c), 0, 0};
    cell.box.axes = {Float3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    cell.box.half_extents = {0.5f, 0.5f, 0.5f};
    cell.first = 100 * c, cell.count = 100;
    cells.push_back(cell);
  }
  std::vector<std::uint32_t> order(400);
  std::iota(order.rbegin(), order.rend(), 0u);
  f.cells = cells, f.order = order;
  f.views = std::vector<Float3>{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  f.view_triangles = std::vector<std::array<std::uint32_t, 3>>{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                                               {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  std::vector<CellVisibility> visibility;
  for (std::uint32_t c = 0; c < 4; ++c)
    for (std::uint32_t v = 0; v < 6; ++v) visibility.push_back({25 * (c + 1), 100});
  f.visibility = visibility;
  f.parameters.near = 10, f.parameters.far = 110, f.parameters.least = 0.1f;
  return f;
}

double visibility_of(const FoliageCells& f, std::size_t cell, const Double3& d) {
  const ViewWeights w = view_weights(f, d);
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += w.weight[k] * f.at(cell, w.view[k]).share();
  return sum;
}

TEST(FoliageLevels, TheRampsAreThoseOfThePaper) {
  FoliageParameters p;
  p.near = 1, p.far = 11, p.least = 0, p.half_distance = 2, p.ramp = FoliageParameters::Ramp::power;
  for (const auto& [z, u] : {std::pair{1.0, 1.0}, {2.0, 0.5}, {4.0, 0.25}, {8.0, 0.125}})
    EXPECT_NEAR(ramp_share(p, z), u, 1e-12);
  p.half_distance = 4;
  EXPECT_NEAR(ramp_share(p, 2), std::numbers::sqrt2 / 2, 1e-12);
  EXPECT_EQ(ramp_share(p, 0.1), 1);
  p.ramp = FoliageParameters::Ramp::linear;
  EXPECT_NEAR(ramp_share(p, 6), 0.5, 1e-12);
  EXPECT_EQ(ramp_share(p, 50), 0);
  EXPECT_EQ(ramp_share(p, std::nan("")), 1);
  p.near = p.far = 5;
  EXPECT_EQ(ramp_share(p, 5.1), p.least) << "a step";
}

TEST(FoliageLevels, AtAStoredViewpointTheStoredValueAndInBetweenNoJump) {
  FoliageCells f = four_cells();
  std::vector<CellVisibility> v = f.visibility.to_vector();
  for (std::uint32_t i = 0; i < 6; ++i) v[i] = {10 * i, 60};
  f.visibility = v;
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_NEAR(visibility_of(f, 0, to_double(f.views[i])), f.at(0, i).share(), 1e-12);
  EXPECT_NEAR(visibility_of(f, 1, {0.3, -0.7, 0.2}), 0.5, 1e-12) << "a constant stays constant";
  double before = -1;
  for (int i = 0; i <= 2000; ++i) {
    const double a = 2 * std::numbers::pi * i / 2000;
    const double now = visibility_of(f, 0, {std::cos(a), 0.7 * std::sin(a), std::sin(a + 0.4)});
    if (before >= 0) {
      EXPECT_NEAR(now, before, 0.02) << i;
    }
    before = now;
  }
  EXPECT_EQ(view_weights(f, {}).weight[0], 0);
}

TEST(FoliageLevels, UniformlyEveryCellHasTheShareOfItsDistance) {
  FoliageCells f = four_cells();
  f.parameters.distance = FoliageParameters::Distance::tree;
  const FoliageLevels levels(f);
  std::vector<CellLevel> out(4);
  for (const double z : {5.0, 40.0, 60.0, 500.0}) {
    levels.choose({1.5, 0, z}, {.uniform = true}, out);
    for (const CellLevel& cell : out)
      EXPECT_EQ(cell.count, std::ceil(100 * ramp_share(f.parameters, z) - 1e-7)) << z;
  }
}

// Of a cell whose leaves have area 1.
double shown_area(const CellLevel& cell) {
  return cell.count > 0 ? (cell.count - 1.0 + double{cell.last}) * double{cell.enlargement} : 0;
}

TEST(FoliageLevels, NothingPopsWhileTheEyeMovesAway) {
  const FoliageCells f = four_cells();
  const FoliageLevels levels(f);
  std::vector<CellLevel> before(4), now(4);
  const double step = 0.003;  // metres: at most .003 leaves of a cell
  levels.choose({1.5, 0, 30}, {}, before);
  int gone = 0;
  for (double z = 30 + step; z < 34; z += step) {
    levels.choose({1.5, 0, z}, {}, now);
    for (std::size_t c = 0; c < 4; ++c) {
      ASSERT_GT(now[c].last, 0);
      ASSERT_LE(now[c].last, 1);
      // Of what is left of the last leaf at most as much is gone as the eye has moved, in leaves.
      const double left = now[c].count - 1.0 + double{now[c].last},
                   was = before[c].count - 1.0 + double{before[c].last};
      ASSERT_NEAR(left, was, 0.01) << c << " at " << z;
      ASSERT_NEAR(now[c].enlargement, before[c].enlargement, 1e-3);
      gone += now[c].count < before[c].count;
    }
    before.swap(now);
  }
  EXPECT_GE(gone, 5) << "leaves have gone";
}

TEST(FoliageLevels, TheAreaOfWhatDistanceTakesIsKeptExactly) {
  FoliageCells f = four_cells();
  const FoliageLevels levels(f);
  std::vector<CellLevel> out(4);
  for (const bool shrinking : {false, true}) {
    levels.choose({1.5, 0, 60}, {.uniform = true, .shrinking = shrinking}, out);
    for (const CellLevel& cell : out) EXPECT_NEAR(shown_area(cell), 100, 1e-4);
  }
  // What is hidden is not made good unless that is asked for.
  levels.choose({1.5, 0, 9.7}, {}, out);
  EXPECT_LT(out[0].count, 100u);
  EXPECT_NEAR(out[0].enlargement, 1, 1e-6);
  f.parameters.compensation = FoliageParameters::Compensation::total;
  levels.choose({1.5, 0, 9.7}, {}, out);
  EXPECT_NEAR(shown_area(out[0]), 100, 1e-4);
  f.parameters.largest_enlargement = 1.5f;
  levels.choose({1.5, 0, 500}, {}, out);
  for (const CellLevel& cell : out) EXPECT_LE(cell.enlargement, 1.5f);
}

// What is drawn of all cells, by the areas that leaves have.
double drawn_area(const FoliageCells& f, const FoliageLevels& levels, const std::vector<CellLevel>& drawn,
                  const std::vector<LeafSize>& sizes) {
  double sum = 0;
  for (std::size_t c = 0; c < drawn.size(); ++c)
    for (std::uint32_t i = 0; i < drawn[c].count; ++i) {
      const std::size_t place = f.cells[c].first + i;
      const float part = i + 1 == drawn[c].count ? drawn[c].last : 1.0f;
      sum += double{sizes[f.order[place]].area} * double{levels.enlargement(drawn[c], place)} * double{part};
    }
  return sum;
}

TEST(FoliageLevels, UnequalLeavesKeepTheSumOfTheirAreas) {
  FoliageCells f = four_cells();
  f.parameters.largest_enlargement = 1e4f;
  std::vector<LeafSize> sizes(400);
  double all = 0;
  for (std::size_t i = 0; i < 400; ++i) all += sizes[i].area = i % 25 == 3 ? 4.0f : 0.01f;
  const FoliageLevels levels(f, sizes);
  std::vector<CellLevel> out(4);
  for (const bool shrinking : {false, true})
    for (const double z : {20.0, 60.0, 105.0, 400.0}) {
      levels.choose({1.5, 0, z}, {.uniform = true, .shrinking = shrinking}, out);
      EXPECT_NEAR(drawn_area(f, levels, out, sizes), all, 1e-4 * all) << z;
    }
}

TEST(FoliageLevels, NoLeafGrowsFartherThanItCanAndItsNeighboursDoInstead) {
  FoliageCells f = four_cells();
  std::vector<LeafSize> sizes(400);
  for (std::size_t i = 0; i < 400; ++i) sizes[i] = {1, i % 3 == 0 ? 1.2f : 15.0f};
  for (std::uint32_t i = 0; i < 100; ++i) sizes[f.order[i]].most = 1;  // the first cell cannot grow at all
  const FoliageLevels levels(f, sizes);
  std::vector<CellLevel> out(4);
  levels.choose({1.5, 0, 60}, {.uniform = true}, out);
  EXPECT_NEAR(drawn_area(f, levels, out, sizes), 400, 1e-3);
  for (std::size_t c = 0; c < 4; ++c)
    for (std::uint32_t i = 0; i < out[c].count; ++i) {
      const std::size_t place = f.cells[c].first + i;
      EXPECT_LE(levels.enlargement(out[c], place), sizes[f.order[place]].most);
    }
  EXPECT_GT(out[1].enlargement, out[3].enlargement) << "the next cell takes what the first cannot hold";
}

TEST(FoliageLevels, AFartherEyeDrawsASubset) {
  const FoliageCells f = four_cells();
  const FoliageLevels levels(f);
  std::vector<CellLevel> out(4);
  std::vector<std::uint32_t> list(levels.leaf_count());
  std::set<std::uint32_t> before;
  for (double z = 4; z < 300; z *= 1.3) {
    levels.choose({1.5, 0, z}, {}, out);
    const std::size_t n = levels.extract(out, list);
    std::size_t sum = 0;
    for (const CellLevel& cell : out) sum += cell.count;
    EXPECT_EQ(n, sum);
    const std::set<std::uint32_t> now(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(n));
    EXPECT_EQ(now.size(), n) << "no leaf twice";
    if (!before.empty()) {
      EXPECT_TRUE(std::includes(before.begin(), before.end(), now.begin(), now.end())) << z;
    }
    before = now;
  }
}

TEST(FoliageLevels, FromInsideTheCrownEverythingIsDrawn) {
  const FoliageCells f = four_cells();
  const FoliageLevels levels(f);
  std::vector<CellLevel> out(4);
  std::vector<std::uint32_t> list(levels.leaf_count());
  levels.choose({1.5, 0, 0}, {}, out);
  ASSERT_EQ(levels.extract(out, list), 400u);
  std::sort(list.begin(), list.end());
  for (std::uint32_t i = 0; i < 400; ++i) ASSERT_EQ(list[i], i);
  levels.choose({std::nan(""), 0, 0}, {}, out);
  for (const CellLevel& cell : out) EXPECT_EQ(cell.count, 100u) << "not a number: full detail";
  EXPECT_EQ(levels.extract(out, std::span(list).first(399)), 0u) << "no room: nothing is written";
}

}  // namespace
}  // namespace copse
