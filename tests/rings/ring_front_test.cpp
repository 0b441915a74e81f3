#include "lib/analysis/rings/ring_front.h"

#include "tests/trunk/tube_maker.h"

#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

TrunkMesh tube(int sides, int rings, Diagonals diagonals, TubeEnd last = TubeEnd::open) {
  TubeShape shape;
  shape.axis = axis_between({0, 0, 0}, {0, 4, 0}, rings);
  shape.radius = taper_between(0.5, 0.3, rings);
  shape.sides = sides;
  shape.diagonals = diagonals;
  shape.last = last;
  TubeMaker maker;
  maker.add(shape);
  return make_trunk_mesh(maker.mesh, all_trunk(maker.mesh));
}

std::vector<std::uint32_t> first_ring(std::uint32_t sides) {
  std::vector<std::uint32_t> ring;
  for (std::uint32_t j = 0; j < sides; ++j) ring.push_back(j);
  return ring;
}

TEST(RingFront, FindsEveryRingFromOne) {
  for (const Diagonals d : {Diagonals::forward, Diagonals::backward, Diagonals::random}) {
    const TrunkMesh mesh = tube(6, 5, d, TubeEnd::lid);
    const Fans fans = make_fans(mesh.positions.size(), mesh.triangles);
    RingFront front(mesh, fans);
    ASSERT_TRUE(front.read(first_ring(6), true, RingSizes::constant));
    EXPECT_EQ(front.rings().size(), 5u);
    EXPECT_EQ(front.triangles().size(), mesh.triangles.size());
    for (std::uint32_t r = 0; r < 5; ++r) {
      for (std::uint32_t j = 0; j < 6; ++j) EXPECT_EQ(front.rings().ring(r)[j], 6 * r + j);
    }
    for (std::uint32_t t = 0; t < 48; ++t) EXPECT_EQ(front.owner(t), 1 + t / 12);
    for (std::uint32_t t = 48; t < 52; ++t) EXPECT_TRUE(front.is_lid(t) && front.owner(t) == 4);
  }
}

TEST(RingFront, ReadsFromThePointAtTheEnd) {
  const TrunkMesh mesh = tube(5, 4, Diagonals::random, TubeEnd::point);
  const Fans fans = make_fans(mesh.positions.size(), mesh.triangles);
  RingFront front(mesh, fans);
  ASSERT_TRUE(front.read(std::vector<std::uint32_t>{20}, false, RingSizes::constant));
  EXPECT_EQ(front.rings().size(), 5u);
  EXPECT_EQ(front.rings().ring(4).size(), 5u);
}

TEST(RingFront, RefusesWhatIsNoRingAndForgetsIt) {
  const TrunkMesh mesh = tube(6, 5, Diagonals::forward);
  const Fans fans = make_fans(mesh.positions.size(), mesh.triangles);
  RingFront front(mesh, fans);
  EXPECT_FALSE(front.read(std::vector<std::uint32_t>{0, 1, 7, 6}, true, RingSizes::any));
  EXPECT_FALSE(front.read(std::vector<std::uint32_t>{8}, false, RingSizes::constant));
  EXPECT_FALSE(front.read(std::vector<std::uint32_t>{0, 1, 0}, true, RingSizes::any));
  EXPECT_TRUE(front.read(first_ring(6), true, RingSizes::any));
  EXPECT_EQ(front.triangles().size(), mesh.triangles.size());
}

TEST(RingFront, ReadsBandsBetweenRingsOfDifferentSizes) {
  // A triangle inside a hexagon, with an annulus of nine triangles between them.
  TrunkMesh mesh;
  for (int j = 0; j < 6; ++j) mesh.positions.push_back({std::cos(j * 1.0472), 0, std::sin(j * 1.0472)});
  for (int j = 0; j < 3; ++j) mesh.positions.push_back({std::cos(j * 2.0944), 2, std::sin(j * 2.0944)});
  mesh.triangles = {{0, 1, 6}, {1, 2, 7}, {1, 7, 6}, {2, 3, 7}, {3, 4, 8},
                    {3, 8, 7}, {4, 5, 8}, {5, 0, 6}, {5, 6, 8}};
  const Fans fans = make_fans(9, mesh.triangles);
  RingFront front(mesh, fans);
  EXPECT_TRUE(front.read(first_ring(6), true, RingSizes::any));
  EXPECT_EQ(front.rings().size(), 2u);
  EXPECT_FALSE(front.read(first_ring(6), true, RingSizes::constant));
}

}  // namespace
}  // namespace copse
