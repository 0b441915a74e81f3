#include "lib/analysis/rings/ring_reader.h"

#include "lib/analysis/surface/surfaces.h"
#include "tests/trunk/tube_maker.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace copse {
namespace {

// Reads every surface of a mesh that is all trunk; `failures` counts those without rings.
struct Reading {
  explicit Reading(const Mesh& mesh) : trunk(make_trunk_mesh(mesh, all_trunk(mesh))) {
    limbs.owner.assign(trunk.triangles.size(), k_none);
    limbs.lid.assign(trunk.triangles.size(), 0);
    const Fans fans = make_fans(trunk.positions.size(), trunk.triangles);
    const Surfaces surfaces = make_surfaces(trunk);
    RingReader reader(trunk, fans);
    for (std::uint32_t s = 0; s < surfaces.size(); ++s) {
      failures += !reader.read(surfaces.triangles(s), surfaces.vertices(s), limbs);
    }
  }
  TrunkMesh trunk;
  Limbs limbs;
  int failures = 0;
};

// Whether the rings are those of the shape, from one end to the other, and nothing else but the points at its
// ends.
::testing::AssertionResult reads_as(const Reading& reading, const TubeShape& shape) {
  if (reading.failures > 0 || reading.limbs.size != 1) return ::testing::AssertionFailure() << "not one limb";
  std::size_t found = 0, points = 0;
  for (std::uint32_t r = 0; r < reading.limbs.rings(); ++r) {
    if (reading.limbs.source[r] == RadiusSource::point) {
      ++points;
      continue;
    }
    for (std::size_t i = 0; i < shape.axis.size(); ++i) {
      found += distance(reading.limbs.centre[r], shape.axis[i]) < 1e-9 &&
               std::abs(reading.limbs.diameter[r] - 2 * shape.radius[i]) < 1e-9 &&
               reading.limbs.ring(r).size() == static_cast<std::size_t>(shape.sides);
    }
  }
  const std::size_t want_points = (shape.first == TubeEnd::point) + (shape.last == TubeEnd::point);
  if (found != shape.axis.size() || points != want_points || reading.limbs.rings() != found + points) {
    return ::testing::AssertionFailure() << found << " of " << shape.axis.size() << " rings, " << points
                                         << " points, " << reading.limbs.rings() << " in all";
  }
  for (const std::uint32_t owner : reading.limbs.owner) {
    if (owner == k_none) return ::testing::AssertionFailure() << "a triangle without an owner";
  }
  return ::testing::AssertionSuccess();
}

TubeShape straight(int sides, int rings) {
  TubeShape shape;
  shape.axis = axis_between({0, 0, 0}, {1, 8, 2}, rings, 0.7);
  shape.radius = taper_between(0.5, 0.2, rings);
  shape.sides = sides;
  return shape;
}

Mesh mesh_of(const TubeShape& shape) {
  TubeMaker maker;
  maker.add(shape);
  return maker.mesh;
}

RC_GTEST_PROP(RingReader, ReadsEveryTubeWhateverItsSidesEndsDiagonalsSeamsAndOrder, ()) {
  TubeShape shape = straight(*rc::gen::inRange(3, 25), *rc::gen::inRange(3, 20));
  const auto end = [] {
    return *rc::gen::element(TubeEnd::open, TubeEnd::fan, TubeEnd::lid, TubeEnd::point);
  };
  shape.first = end();
  shape.last = end();
  shape.diagonals =
      *rc::gen::element(Diagonals::forward, Diagonals::backward, Diagonals::alternating, Diagonals::random);
  shape.seam = *rc::gen::arbitrary<bool>();
  shape.split = *rc::gen::arbitrary<bool>();
  shape.turn = *rc::gen::inRange(0, 10) * 0.1;
  shape.seed = *rc::gen::arbitrary<std::uint32_t>();
  TubeMaker maker;
  maker.add(shape);
  if (*rc::gen::arbitrary<bool>()) maker.shuffle(shape.seed);
  RC_ASSERT(static_cast<bool>(reads_as(Reading(maker.mesh), shape)));
}

TEST(RingReader, ReadsTheLongAxisOfABox) {
  for (const int rings : {2, 3, 6}) {
    TubeShape box = straight(4, rings);
    box.axis = axis_between({0, 0, 0}, {0, 5, 0}, rings);
    box.radius = taper_between(0.5, 0.5, rings);
    box.first = box.last = TubeEnd::lid;
    EXPECT_TRUE(reads_as(Reading(mesh_of(box)), box)) << rings;
  }
}

TEST(RingReader, ReadsAShearedTubeWithLids) {
  for (const double shear : {1.0, 3.0, 8.0}) {
    TubeShape shape = straight(5, 2);
    shape.axis = axis_between({0, 0, 0}, {0, 1, 0}, 2);
    shape.first = shape.last = TubeEnd::lid;
    Mesh mesh = mesh_of(shape);
    for (Double3& p : mesh.positions) p.x += shear * std::round(p.y);
    shape.axis[1].x = shear;
    EXPECT_TRUE(reads_as(Reading(mesh), shape)) << shear;
  }
}

TEST(RingReader, ReadsStripsByTheirRungs) {
  for (const Diagonals diagonals : {Diagonals::forward, Diagonals::backward, Diagonals::alternating}) {
    for (const double width : {0.02, 0.3, 1.0}) {
      TubeShape blade;
      blade.axis = axis_between({0, 0, 0}, {0, 0.6, 0}, 6);
      blade.radius = taper_between(width / 2, width / 4, 6);
      blade.sides = 2;
      blade.diagonals = diagonals;
      EXPECT_TRUE(reads_as(Reading(mesh_of(blade)), blade)) << width;
    }
  }
}

TEST(RingReader, ReadsABillboardThatIsWiderThanHighFromItsFootInTheGround) {
  TubeShape board;
  board.axis = {{0, -0.01, 0}, {0, 0.2, 0}};
  board.radius = {0.5, 0.5};
  board.sides = 2;
  EXPECT_TRUE(reads_as(Reading(mesh_of(board)), board));
}

TEST(RingReader, ReadsADoubleSidedTube) {
  const TubeShape shape = straight(6, 5);
  Mesh mesh = mesh_of(shape);
  const std::size_t count = mesh.triangles.size();
  for (std::size_t t = 0; t < count; ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    mesh.triangles.push_back({a, c, b});
    mesh.part_of.push_back(0);
  }
  const Reading reading(mesh);
  EXPECT_EQ(reading.failures, 0);
  EXPECT_EQ(reading.limbs.rings(), 5u);
}

TEST(RingReader, ReadsRingsThatSeveralTubesShareAsAStrictModelHasThem) {
  TubeMaker maker;
  maker.add(straight(5, 4));
  // Two more tubes leave the last ring, with its own vertices.
  const std::uint32_t last = 15;
  for (const double x : {-3.0, 3.0}) {
    std::uint32_t from = last;
    for (int ring = 1; ring <= 3; ++ring) {
      const auto to = static_cast<std::uint32_t>(maker.mesh.positions.size());
      for (std::uint32_t j = 0; j < 5; ++j) {
        maker.mesh.positions.push_back(maker.mesh.positions[last + j] + Double3{x * ring, 2.0 * ring, 0});
      }
      for (std::uint32_t j = 0; j < 5; ++j) {
        const std::uint32_t n = (j + 1) % 5;
        maker.mesh.triangles.push_back({from + j, from + n, to + n});
        maker.mesh.triangles.push_back({from + j, to + n, to + j});
      }
      from = to;
    }
  }
  const Reading reading(maker.mesh);
  EXPECT_EQ(reading.failures, 0);
  ASSERT_EQ(reading.limbs.rings(), 10u);
  std::vector<int> children(10, 0);
  for (const std::uint32_t p : reading.limbs.parent) {
    if (p != k_none) ++children[p];
  }
  EXPECT_EQ(std::ranges::count(children, 2), 1);
}

TEST(RingReader, KeepsRingOrderSoThatVertexContinuesVertex) {
  TubeShape shape = straight(7, 6);
  shape.diagonals = Diagonals::random;
  TubeMaker maker;
  maker.add(shape);
  maker.shuffle(5);
  const Reading reading(maker.mesh);
  for (std::uint32_t r = 0; r < reading.limbs.rings(); ++r) {
    if (reading.limbs.parent[r] == k_none) continue;
    for (std::uint32_t j = 0; j < 7; ++j) {
      const Double3& here = reading.trunk.positions[reading.limbs.ring(r)[j]];
      double nearest = 1e9;
      for (const std::uint32_t v : reading.limbs.ring(r)) {
        nearest = std::min(nearest,
                           distance(reading.trunk.positions[v],
                                    reading.trunk.positions[reading.limbs.ring(reading.limbs.parent[r])[j]]));
      }
      EXPECT_NEAR(distance(here, reading.trunk.positions[reading.limbs.ring(reading.limbs.parent[r])[j]]),
                  nearest, 0.01 * nearest);  // the axis bends
    }
  }
}

TEST(RingReader, LeavesLumpsAlone) {
  TubeMaker maker;
  maker.add(straight(6, 5));
  // A handle: one triangle more, from the first ring to the last.
  maker.mesh.triangles.push_back({0, 1, 28});
  EXPECT_EQ(Reading(maker.mesh).failures, 1);
}

TEST(RingReader, ReadsATubeOfAHundredThousandRings) {
  TubeShape vine = straight(3, 100000);
  vine.axis = axis_between({0, 0, 0}, {0, 1000, 0}, 100000);
  vine.radius = taper_between(0.01, 0.001, 100000);
  const Reading reading(mesh_of(vine));
  EXPECT_EQ(reading.limbs.rings(), 100000u);
}

}  // namespace
}  // namespace copse
