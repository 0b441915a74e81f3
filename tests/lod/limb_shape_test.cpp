#include "lib/analysis/lod/limb_shape.h"

#include "tests/lod/tube_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace copse {
namespace {

struct Limb {
  Tree tree;
  std::vector<Double3> centres;
  PartTriangles trunk;
  std::vector<LimbChain> chains;
  LimbShape shape;
  explicit Limb(Tree of)
      : tree(std::move(of)),
        centres(absolute_centres(tree)),
        trunk(trunk_triangles(tree)),
        chains(limb_chains(tree)),
        shape(tree, centres, trunk, chains.at(0)) {}
};

std::vector<SpectrumVertex> ring_vertices(const LimbShape& shape, std::size_t i, std::size_t interval,
                                          std::uint32_t sides, double angle) {
  std::vector<SpectrumVertex> out;
  shape.append_ring(i, interval, sides, 0, angle, 1, out);
  return out;
}

double perimeter(const std::vector<SpectrumVertex>& ring) {
  double sum = 0;
  for (std::size_t j = 0; j + 1 < ring.size(); ++j)
    sum += distance(to_double(ring[j].position), to_double(ring[j + 1].position));
  return sum;
}

TEST(LimbShape, ReadsRegularRings) {
  const Limb limb(stem_with_twigs(4, 8, 0));
  EXPECT_TRUE(limb.shape.regular());
  EXPECT_EQ(limb.shape.sides(), 8u);
  EXPECT_FALSE(limb.shape.pointed());
  EXPECT_NEAR(limb.shape.length_between(0, 3), 3, 1e-6);
}

TEST(LimbShape, ARingWithFewerSidesHasTheSamePerimeter) {
  const Limb limb(stem_with_twigs(4, 12, 0));
  const double full = perimeter(ring_vertices(limb.shape, 1, 1, 12, 0));
  EXPECT_NEAR(full, 12 * 2 * 0.5 * std::sin(std::numbers::pi / 12), 1e-5);
  for (const std::uint32_t k : {8u, 6u, 5u, 4u, 3u})
    EXPECT_NEAR(perimeter(ring_vertices(limb.shape, 1, 1, k, 0)), full, 1e-5) << k;
}

TEST(LimbShape, ARibbonIsAsWideOnAverageAsTheTube) {
  const Limb limb(stem_with_twigs(4, 64, 0));
  const std::vector<SpectrumVertex> ends = ring_vertices(limb.shape, 2, 1, 2, 0.3);
  ASSERT_EQ(ends.size(), 2u);
  // Seen from all round a strip of width w shows 2 w / pi.
  EXPECT_NEAR(distance(to_double(ends[0].position), to_double(ends[1].position)) * 2 / std::numbers::pi, 1.0,
              1e-3);
}

// A strip of two vertices a ring, .2 wide along a level direction, that leans over; one vertex at its tip.
Tree blade(int rings, double angle, bool pointed) {
  Tube tube;
  std::uint32_t before = k_none;
  const Double3 half{0.1 * std::cos(angle), 0, 0.1 * std::sin(angle)}, lean{-half.z, 0, half.x};
  for (int i = 0; i < rings; ++i) {
    const bool tip = pointed && i + 1 == rings;
    const Double3 centre = lean * (0.1 * i * i) + Double3{0, 0.3 * i, 0};
    const auto ring = tube.add_ring(centre, 0, tip ? 1 : 2, before, true);
    tube.hierarchy.radii[ring].diameter = tip ? 0 : 0.2;
    tube.hierarchy.radii[ring].joint = false;
    const std::uint32_t c = tube.hierarchy.first_vertex[ring];
    tube.mesh.positions[c] = tip ? centre : centre - half;
    if (!tip) tube.mesh.positions[c + 1] = centre + half;
    if (i > 0) {
      const std::uint32_t p = tube.hierarchy.first_vertex[before];
      tube.add_triangle({p, p + 1, c}, ring);
      if (!tip) tube.add_triangle({p + 1, c + 1, c}, ring);
    }
    before = ring;
  }
  return tree_of(tube);
}

TEST(LimbShape, AStripStaysInItsPlaneAndIsAsWideAsItIs) {
  for (const bool pointed : {false, true}) {
    const Limb limb(blade(6, 0.7, pointed));
    EXPECT_EQ(limb.shape.sides(), 2u);
    EXPECT_TRUE(limb.shape.regular());
    EXPECT_EQ(limb.shape.triangles(6, 2), pointed ? 9u : 10u);
    for (const std::size_t interval : {1u, 2u}) {
      const std::vector<SpectrumVertex> ring = ring_vertices(limb.shape, 2, interval, 2, 1.9);
      ASSERT_EQ(ring.size(), 2u);
      const Double3 across = to_double(ring[1].position) - to_double(ring[0].position);
      EXPECT_NEAR(across.x, 0.2 * std::cos(0.7), 1e-6);
      EXPECT_NEAR(across.z, 0.2 * std::sin(0.7), 1e-6);
    }
    EXPECT_NEAR(limb.shape.ring(2).perimeter, 0.4, 1e-6);
  }
}

TEST(LimbShape, ASpikeIsAsLargeAsTheRibbonThatItStandsFor) {
  for (const double last : {0.5, 0.2, 0.05}) {
    Tube tube;
    tube.add_ring({0, 2, 0}, last, 64, tube.add_ring({0, 0, 0}, 0.5, 64, k_none));
    const Limb limb(tree_of(tube));
    const auto low = ring_vertices(limb.shape, 0, 0, 2, 0.7), high = ring_vertices(limb.shape, 1, 0, 2, 0.7);
    const auto place = [](const SpectrumVertex& v) { return to_double(v.position); };
    const double ribbon = distance(place(low[0]), place(low[1])) + distance(place(high[0]), place(high[1]));
    const auto spike = limb.shape.spike(0.7);
    EXPECT_NEAR(distance(place(spike[0]), place(spike[1])), ribbon, 1e-5);
    EXPECT_NEAR(distance(place(spike[2]), {0, 2, 0}), 0, 1e-6);
  }
}

TEST(LimbShape, LeavingOutRingsOfAStraightStemCostsNothing) {
  const Limb limb(stem_with_twigs(9, 6, 0));
  EXPECT_NEAR(limb.shape.area_error(0, 8), 0, 1e-6);
}

TEST(LimbShape, LeavingOutABendCostsItsDeviation) {
  Tube tube;
  const auto a = tube.add_ring({0, 0, 0}, 0.1, 6, k_none), b = tube.add_ring({0.5, 1, 0}, 0.1, 6, a);
  tube.add_ring({0, 2, 0}, 0.1, 6, b);
  const Limb limb(tree_of(tube));
  EXPECT_NEAR(limb.shape.largest_error(0, 2), 0.5, 1e-6);
  EXPECT_GT(limb.shape.area_error(0, 2), 0.2);
}

TEST(LimbShape, WhatIsMadeStraightIsWiderByWhatItLosesInLength) {
  Tube tube;
  const auto a = tube.add_ring({0, 0, 0}, 0.1, 6, k_none), b = tube.add_ring({0.5, 1, 0}, 0.1, 6, a);
  tube.add_ring({0, 2, 0}, 0.1, 6, b);
  const Limb limb(tree_of(tube));
  const std::uint32_t ends[] = {0, 2}, all[] = {0, 1, 2};
  EXPECT_EQ(limb.shape.wider(all), 1);
  EXPECT_NEAR(limb.shape.wider(ends), std::hypot(1, 0.5), 0.05);  // in steps of a twentieth
}

TEST(LimbShape, WhatIsThickerThanBothEndsIsWiderWithoutItsMiddleButNotWithoutLimit) {
  const auto bulging = [](double middle) {
    Tube tube;
    const auto a = tube.add_ring({0, 0, 0}, 0.1, 6, k_none), b = tube.add_ring({0, 1, 0}, middle, 6, a);
    tube.add_ring({0, 2, 0}, 0.1, 6, b);
    return Limb(tree_of(tube));
  };
  const std::uint32_t ends[] = {0, 2};
  EXPECT_NEAR(bulging(0.14).shape.wider(ends), 1.2, 1e-9);
  EXPECT_EQ(bulging(0.9).shape.wider(ends), 1.5);
}

// The third ring of a stem with other heights of its vertices.
template <class Height>
Limb with_heights(Height height) {
  Tree tree = stem_with_twigs(5, 8, 0);
  std::vector<Float3> vectors = tree.hierarchy.vectors.to_vector();
  for (std::size_t v = tree.first_vector_of(2); v < tree.first_vector_of(3); ++v)
    vectors[v].y = height(vectors[v], v);
  tree.hierarchy.vectors = vectors;
  return Limb(std::move(tree));
}

TEST(LimbShape, ATiltedRingStaysWhatItIsAndIsAsThickAsItLooks) {
  const Limb limb = with_heights([](const Float3& v, std::size_t) { return 3 * v.x; });
  const RingShape &tilted = limb.shape.ring(2), &level = limb.shape.ring(1);
  EXPECT_EQ(tilted.sides, 8u);
  EXPECT_NEAR(tilted.perimeter, level.perimeter, 1e-6);
  EXPECT_NEAR(tilted.radius, level.radius, 0.03 * level.radius);
}

TEST(LimbShape, ACrownOfPointsIsNoRing) {
  const Limb limb = with_heights([](const Float3&, std::size_t v) { return v % 2 == 0 ? 0.9f : -0.9f; });
  EXPECT_EQ(limb.shape.ring(2).sides, 0u);
}

TEST(LimbShape, WhatIsThickForTheTreeCountsMore) {
  const Limb limb(stem_with_twigs(5, 8, 0));  // 4 m high, 0.5 m of radius
  EXPECT_NEAR(limb.shape.weight(0), 1 + 80 * 0.5 / 4, 0.01);
}

std::uint32_t ring_before(const Tube& tube) {
  return static_cast<std::uint32_t>(tube.hierarchy.radii.size() - 1);
}

// A straight stem whose rings turn by `degrees` from one to the next, with its vertices and its texture,
// which goes `times` round it.
Limb turning(int rings, int sides, double degrees, double times) {
  Tube tube;
  const auto k = static_cast<std::uint32_t>(sides);
  for (int i = 0; i < rings; ++i) {
    const std::uint32_t ring =
        tube.add_ring({0, 1.0 * i, 0}, 0.5, sides, i == 0 ? k_none : ring_before(tube));
    for (std::uint32_t j = 0; j < k; ++j) {
      const double at = 2 * std::numbers::pi * j / k + i * degrees * std::numbers::pi / 180;
      tube.mesh.positions[tube.hierarchy.first_vertex[ring] + j] = {0.5 * std::cos(at), 1.0 * i,
                                                                    0.5 * std::sin(at)};
    }
  }
  Tree tree = tree_of(tube);
  std::vector<Float2> texcoords;
  for (int i = 0; i < rings; ++i)
    for (std::uint32_t j = 0; j <= k; ++j)
      texcoords.push_back({static_cast<float>(times * j / k), static_cast<float>(i)});
  auto triangles = tree.trunk.triangles.to_vector();
  for (auto& t : triangles) {
    std::array<std::uint32_t, 3> in{};
    for (std::size_t c = 0; c < 3; ++c) in[c] = t.vertex[c] % k;
    const bool seam = std::ranges::count(in, 0u) > 0 && std::ranges::count(in, k - 1) > 0;
    for (std::size_t c = 0; c < 3; ++c)
      t.texcoord[c] = t.vertex[c] / k * (k + 1) + (seam && in[c] == 0 ? k : in[c]);
  }
  tree.trunk.texcoords = texcoords, tree.trunk.triangles = triangles;
  return Limb(std::move(tree));
}

// The vertices of ring `to` in the band that comes from ring `from`.
std::vector<SpectrumVertex> upper_ring(const LimbShape& shape, std::size_t from, std::size_t to,
                                       std::uint32_t sides) {
  std::vector<SpectrumVertex> out;
  shape.append_ring(to, to - 1, sides, shape.turn(from, to, sides), 0, 1, out);
  return out;
}

TEST(LimbShape, ABandThatSpansRingsThatTurnIsNotTwisted) {
  for (const double degrees : {-31.0, -13.0, 0.0, 5.0, 25.0}) {
    const Limb limb = turning(9, 7, degrees, 1);
    for (const std::uint32_t k : {7u, 5u, 4u, 3u}) {
      const auto low = ring_vertices(limb.shape, 1, 1, k, 0), high = upper_ring(limb.shape, 1, 8, k);
      const double radius = std::hypot(low[0].position.x, low[0].position.z);
      // The middle of an edge between the rings is no nearer the axis than the middle of a side.
      const auto middle = [&](std::size_t a, std::size_t b) {
        return 0.5 * std::hypot(double{low[a].position.x} + high[b].position.x,
                                double{low[a].position.z} + high[b].position.z);
      };
      for (std::size_t j = 0; j < k; ++j) {
        EXPECT_GE(middle(j, j), 0.99 * radius * std::cos(std::numbers::pi / k)) << degrees << " " << k;
        EXPECT_GE(middle(j + 1, j), 0.85 * radius * std::cos(std::numbers::pi / k)) << degrees << " " << k;
      }
    }
  }
}

TEST(LimbShape, ARingWithAllItsSidesHasTheVerticesOfTheMesh) {
  const Limb limb = turning(9, 7, 13, 1);
  const std::size_t first = limb.tree.first_vector_of(8);
  for (const SpectrumVertex& v : upper_ring(limb.shape, 1, 8, 7)) {
    double nearest = 1;
    for (std::size_t j = 0; j < 7; ++j)
      nearest =
          std::min(nearest, distance(to_double(v.position),
                                     limb.centres[8] + to_double(limb.tree.hierarchy.vectors[first + j])));
    EXPECT_LT(nearest, 1e-6);
  }
}

TEST(LimbShape, ATextureThatRepeatsGoesOnRoundARingThatTurns) {
  for (const double degrees : {-31.0, -13.0, 25.0}) {
    const Limb limb = turning(9, 7, degrees, 2);
    for (const std::uint32_t k : {7u, 4u}) {
      const auto low = ring_vertices(limb.shape, 1, 1, k, 0), high = upper_ring(limb.shape, 1, 8, k);
      // The frames of a limb go round the other way than the texture.
      for (std::size_t j = 0; j < k; ++j) {
        EXPECT_NEAR(low[j].texcoord.x - low[j + 1].texcoord.x, 2.0 / k, 0.02) << degrees << " " << k;
        EXPECT_NEAR(high[j].texcoord.x - high[j + 1].texcoord.x, 2.0 / k, 0.02) << degrees << " " << k;
      }
      // Seven rings farther the texture has turned with the mesh.
      const auto angle = [](const SpectrumVertex& v) { return std::atan2(v.position.z, v.position.x); };
      const double on = std::remainder(angle(high[0]) - angle(low[0]), 2 * std::numbers::pi);
      EXPECT_NEAR(high[0].texcoord.x - low[0].texcoord.x,
                  2 * (on / (2 * std::numbers::pi) - 7 * degrees / 360), 0.02)
          << degrees << " " << k;
    }
  }
}

TEST(LimbShape, ATextureThatDoesNotRepeatIsNotTornApart) {
  const Limb limb = turning(4, 6, 10, 0.5);  // half of the picture: the other half is something else
  for (const auto& ring : {ring_vertices(limb.shape, 1, 1, 6, 0), upper_ring(limb.shape, 0, 3, 6)}) {
    EXPECT_NEAR(ring.front().texcoord.x, 0.5, 1e-3);
    EXPECT_NEAR(ring.back().texcoord.x, 0, 1e-3);
  }
}

TEST(LimbShape, RingsThatTurnOtherwiseThanTheirBandCostTheirCorners) {
  const Limb straight = turning(9, 7, 0, 1), turned = turning(9, 7, 20, 1), fine = turning(9, 14, 20, 1);
  EXPECT_NEAR(straight.shape.turned_error(0, 8), 0, 1e-6);
  EXPECT_GT(turned.shape.turned_error(0, 8), 0.01);
  EXPECT_LT(fine.shape.turned_error(0, 8), 0.5 * turned.shape.turned_error(0, 8));
}

TEST(LimbShape, CountsItsTriangles) {
  const Limb limb(stem_with_twigs(5, 6, 0));
  EXPECT_EQ(limb.shape.triangles(5, 6), 48u);
  EXPECT_EQ(limb.shape.triangles(2, 3), 6u);
  EXPECT_EQ(limb.shape.triangles(2, 2), 2u);
}

}  // namespace
}  // namespace copse
