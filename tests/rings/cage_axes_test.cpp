#include "lib/analysis/rings/cage_axes.h"

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

// A cage under construction.
struct Maker {
  Cage cage;

  Maker() {
    cage.levels = 1;
    cage.is_on_limit = true;
    cage.precision = 1e-12;
  }
  std::uint32_t vertex(const Double3& p) {
    cage.vertex.push_back(static_cast<std::uint32_t>(cage.positions.size()));
    cage.positions.push_back(p);
    return cage.vertex.back();
  }
  void face(std::span<const std::uint32_t> corners) {
    cage.face_of.push_back(static_cast<std::uint32_t>(cage.faces.count()));  // one triangle each will do
    cage.faces.items.insert(cage.faces.items.end(), corners.begin(), corners.end());
    cage.faces.first.push_back(static_cast<std::uint32_t>(cage.faces.items.size()));
  }
  using Ring = std::array<std::uint32_t, 4>;
  // A square of half side `radius` across `normal`.
  Ring ring(const Double3& centre, const Double3& normal, double radius) {
    const Double3 n = normalized(normal), u = normalized(cross(n, {0.01, 0.02, 1})), v = cross(n, u);
    return {vertex(centre + (u + v) * radius), vertex(centre + (v - u) * radius),
            vertex(centre - (u + v) * radius), vertex(centre + (u - v) * radius)};
  }
  void band(const Ring& a, const Ring& b) {
    for (std::size_t i = 0; i < 4; ++i) face(std::array{a[i], a[(i + 1) % 4], b[(i + 1) % 4], b[i]});
  }
};

// Rings along a polyline: `between` in each straight piece, mitred at its corners.
std::vector<Maker::Ring> limb(Maker& m, std::span<const Double3> corners, std::span<const double> radii,
                              int between) {
  std::vector<Maker::Ring> rings;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Double3 in = i > 0 ? normalized(corners[i] - corners[i - 1]) : normalized(corners[1] - corners[0]);
    const Double3 out = i + 1 < corners.size() ? normalized(corners[i + 1] - corners[i]) : in;
    rings.push_back(m.ring(corners[i], in + out, radii[i]));
    if (i + 1 == corners.size()) break;
    for (int b = 1; b <= between; ++b) {
      const double t = b / (between + 1.0);
      rings.push_back(
          m.ring(corners[i] * (1 - t) + corners[i + 1] * t, out, radii[i] * (1 - t) + radii[i + 1] * t));
    }
  }
  for (std::size_t i = 1; i < rings.size(); ++i) m.band(rings[i - 1], rings[i]);
  return rings;
}

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

// Three limbs of two rings and more on the faces of a cube, whose other faces are the hull.
struct Fork {
  Maker m;
  Double3 middle{5, 2, -3};

  explicit Fork(double moved = 0) {
    std::array<std::uint32_t, 8> cube{};
    for (std::uint32_t i = 0; i < 8; ++i) {
      cube[i] = m.vertex(middle + Double3{i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0});
    }
    const std::array<Maker::Ring, 3> seats{{{cube[0], cube[1], cube[5], cube[4]},    // below
                                            {cube[2], cube[3], cube[7], cube[6]},    // above
                                            {cube[1], cube[3], cube[7], cube[5]}}};  // beside
    const std::array<Double3, 3> ways{{{0, -1, 0}, {0, 1, 0}, {1, 0, 0}}};
    for (std::size_t l = 0; l < 3; ++l) {
      Maker::Ring last = seats[l];
      for (int step = 1; step <= 3; ++step) {
        Maker::Ring next{};
        for (std::size_t i = 0; i < 4; ++i) next[i] = m.vertex(m.cage.positions[last[i]] + ways[l] * 2.0);
        m.band(last, next);
        last = next;
      }
      m.face(last);
    }
    m.face(std::array{cube[0], cube[2], cube[6], cube[4]});
    m.face(std::array{cube[0], cube[1], cube[3], cube[2]});
    m.face(std::array{cube[4], cube[5], cube[7], cube[6]});
    for (std::size_t i = 0; i < 8; ++i)
      m.cage.positions[cube[i]] += Double3{0.1, 0.2, -0.1} * (moved * static_cast<double>(i));
  }
};

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
