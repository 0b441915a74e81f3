#include "lib/analysis/lod/cell_visibility.h"

#include "tests/measure/shapes_to_draw.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

const std::vector<Double3> k_front{{0, 0, 1}}, k_back{{0, 0, -1}};

TEST(CellVisibility, OfOneCellAloneIsOneFromEverywhere) {
  const DrawnMesh m = square({}, 1);
  for (const Double3& d : view_sphere(1).directions) {
    const auto v = cell_visibility(m, {}, std::vector<std::uint32_t>{0, 0}, 1, std::vector<Double3>{d}, 64);
    EXPECT_EQ(v[0].visible, v[0].total);
  }
}

TEST(CellVisibility, BehindAnOpaquePlateIsNothing) {
  DrawnMesh m = square({0, 0, -1}, 1);
  append(m, square({0, 0, 1}, 2));
  const std::vector<std::uint32_t> cells{0, 0, 1, 1};
  const auto front = cell_visibility(m, {}, cells, 2, k_front, 128),
             back = cell_visibility(m, {}, cells, 2, k_back, 128);
  EXPECT_GT(front[0].total, 1000u);
  EXPECT_EQ(front[0].visible, 0u);
  EXPECT_EQ(front[1].visible, front[1].total);
  EXPECT_EQ(back[0].visible, back[0].total);
  EXPECT_NEAR(back[1].share(), 0.75, 0.02);
}

TEST(CellVisibility, HalfCoveredIsAHalf) {
  DrawnMesh m = square({}, 1);
  append(m, square({1, 0, 1}, 1));
  EXPECT_NEAR(cell_visibility(m, {}, std::vector<std::uint32_t>{0, 0, 1, 1}, 2, k_front, 256)[0].share(), 0.5,
              0.01);
}

TEST(CellVisibility, ACellDoesNotHideItself) {
  DrawnMesh m = square({}, 1);
  append(m, square({0, 0, 1}, 1));
  const auto v = cell_visibility(m, {}, std::vector<std::uint32_t>{0, 0, 0, 0}, 1, k_front, 64);
  EXPECT_EQ(v[0].visible, v[0].total);
}

TEST(CellVisibility, WhatTiesIsVisibleForBoth) {
  DrawnMesh m = square({}, 1);
  append(m, square({}, 1));
  const auto v = cell_visibility(m, {}, std::vector<std::uint32_t>{0, 0, 1, 1}, 2, k_front, 64);
  EXPECT_EQ(v[0].visible, v[0].total);
  EXPECT_EQ(v[1].visible, v[1].total);
}

TEST(CellVisibility, SeesThroughTheHolesOfATexture) {
  const std::vector<AlphaMask> masks{{2, 1, {0, 1}}};
  const std::vector<Material> materials(1);
  DrawnMesh m = square({0, 0, -1}, 1);
  append(m, square({0, 0, 1}, 1, 0));
  const auto v =
      cell_visibility(m, {materials, masks}, std::vector<std::uint32_t>{0, 0, 1, 1}, 2, k_front, 128);
  EXPECT_NEAR(v[0].share(), 0.5, 0.02);
  EXPECT_NEAR(double(v[1].total) / v[0].total, 0.5, 0.02);
}

TEST(CellVisibility, OfNothingIsNothing) {
  EXPECT_EQ(cell_visibility({}, {}, {}, 2, k_front, 16), std::vector<CellVisibility>(2));
}

}  // namespace
}  // namespace copse
