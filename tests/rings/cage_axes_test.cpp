#include "lib/analysis/rings/cage_axes.h"

#include "tests/rings/cages.h"
#include "tests/trunk/welded_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

// What a square tube of radius 1 (half of its side) is subdivided to: four corners at (2/3) sqrt 2 on the
// limit surface and four middles at 11/12.
const double k_round = (2.0 / 3 * std::sqrt(2.0) + 11.0 / 12) / 2;

TEST(CageAxes, KeepsTheCornersOfALineAlone) {
  Maker m;
  const std::vector<Double3> line{{0, 0, 0}, {0, 4, 0}, {1, 8, 0}, {3, 11, 1}};
  const std::vector<double> radii{1, 0.9, 0.6, 0.3};
  const auto rings = limb(m, line, radii, 3);
  m.face(rings.front());
  m.face(rings.back());
  const Hierarchy h = cage_axes(m.cage);
  ASSERT_EQ(h.radii.size(), 4u);
  for (std::uint32_t r = 0; r < 4; ++r) {
    EXPECT_LT(distance(h.radii[r].centre, line[r]), 1e-12);
    EXPECT_NEAR(h.radii[r].diameter, 2 * radii[r] * k_round, 1e-9);
    EXPECT_EQ(h.radii[r].parent, r == 0 ? k_none : r - 1);
    EXPECT_EQ(h.radii[r].branch, 0u);
    EXPECT_EQ(h.first_vertex[r + 1] - h.first_vertex[r], 4u);
  }
  EXPECT_EQ(breach(h, m.cage.positions.size(), m.cage.face_of.size()), "");
  // Each piece of the line explains the bands round it, its end cap included.
  ASSERT_EQ(h.segment_of.size(), 12 * 4 + 2u);
  for (std::uint32_t f = 0; f < 48; ++f) EXPECT_EQ(h.segment_of[f], 1 + f / 16);
  EXPECT_EQ(h.segment_of[48], 1u);
  EXPECT_EQ(h.segment_of[49], 3u);
}

TEST(CageAxes, PutsAForkWhereTheAxesMeet) {
  const Fork fork(0.3);  // the corners of the hull were moved, each by another vector
  const Hierarchy h = cage_axes(fork.m.cage);
  EXPECT_EQ(breach(h, fork.m.cage.positions.size(), fork.m.cage.face_of.size()), "");
  ASSERT_EQ(h.radii.size(), 4u);  // the fork and the three ends
  std::size_t forks = 0;
  for (std::uint32_t r = 0; r < 4; ++r) {
    EXPECT_NEAR(h.radii[r].diameter, 2 * k_round, 1e-9);
    if (h.radii[r].source != RadiusSource::surface) continue;
    ++forks;
    EXPECT_LT(distance(h.radii[r].centre, fork.middle), 1e-9);
    EXPECT_EQ(std::ranges::count(h.radii, r, &RadiusNode::parent), 2);
  }
  EXPECT_EQ(forks, 1u);
  EXPECT_EQ(std::ranges::count(h.segment_of, k_none), 0);
}

// No end to begin with: a frame of cells, alone and with a limb.
TEST(CageAxes, HasOneRootWhereLimbsCloseARing) {
  std::vector<Cell> frame;
  for (int x = 0; x < 5; ++x) {
    for (int y = 0; y < 5; ++y) {
      if (x == 0 || y == 0 || x == 4 || y == 4) frame.push_back({x, y, 0});
    }
  }
  for (const bool with_limb : {false, true}) {
    if (with_limb) frame.insert(frame.end(), {{5, 2, 0}, {6, 2, 0}, {7, 2, 0}});
    const Surface s = surface_of(smooth_cells(frame, 1));
    const auto cage = reverse_subdivision(s);
    ASSERT_TRUE(cage);
    const Hierarchy h = cage_axes(*cage);
    ASSERT_FALSE(h.radii.empty());
    EXPECT_EQ(std::ranges::count(h.radii, k_none, &RadiusNode::parent), 1);
    EXPECT_EQ(breach(h, s.positions.size(), s.triangles.size()), "");
  }
}

TEST(CageAxes, HasNothingToSayOfWhatHasNoRings) {
  Maker cube;
  const auto a = cube.ring({0, 0, 0}, {0, 1, 0}, 1);
  const auto b = cube.ring({0, 1, 0}, {0, 1, 0}, 1);
  cube.face(a);
  cube.face(b);
  EXPECT_TRUE(cage_axes(cube.cage).radii.empty());
  EXPECT_TRUE(cage_axes({}).radii.empty());
}

}  // namespace
}  // namespace copse
