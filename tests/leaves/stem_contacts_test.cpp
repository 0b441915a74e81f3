#include "lib/analysis/leaves/stem_contacts.h"

#include "lib/analysis/surface/weld.h"
#include "tests/leaves/shapes.h"

#include <algorithm>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace copse {
namespace {

using shapes::Builder;
using shapes::line;

// Whether each tube is held by the first, in the order in which they were added.
std::vector<std::uint8_t> held(const Mesh& mesh) {
  const std::vector<PartVerdict> verdicts(mesh.parts.size());
  const std::vector<std::uint32_t> welded = weld(mesh.positions, 0.0), keys(mesh.parts.size(), 0);
  const PieceScan scan(mesh, welded, edge_pieces(mesh.triangles, welded, mesh.part_of, keys), verdicts);
  std::vector<std::uint32_t> stems;
  std::uint32_t first = 0;
  for (std::uint32_t i = 0; i < scan.placed().size(); ++i) {
    if (scan.fact(scan.placed()[i].piece).shape == ShapeKind::stem) stems.push_back(i);
    if (scan.part(scan.placed()[i].piece) == 1) first = i;  // the part called "trunk"
  }
  return stem_contacts(mesh, scan, stems, std::vector{first});
}

// A trunk, 6 m high and 0.4 thick, of 2 rings: what lies in it is far from its vertices.
Builder trunk() {
  Builder b;
  b.part("trunk");
  b.tube(line({0, 0, 0}, {0, 6, 0}, 2), 0.2, 8);
  b.part("others");
  return b;
}

TEST(StemContacts, ATwigHangsOnABoughThatBeginsInsideOnOrALittleOffTheTrunk) {
  for (const double start : {0.0, 0.1, 0.2, 0.21}) {
    Builder b = trunk();
    b.tube(line({start, 3, 0}, {2, 3.5, 0}, 4), 0.05, 6);             // a bough
    b.tube(line({1, 3.26, start / 8}, {1.2, 3.6, 0.6}, 3), 0.01, 4);  // a twig on it
    EXPECT_THAT(held(b.mesh), testing::ElementsAre(1, 1, 1)) << start;
  }
}

TEST(StemContacts, WhatStandsInTheOpenHangsOnNothingAlthoughItHoldsOthers) {
  Builder b = trunk();
  b.tube(line({1, 6, 0}, {1.5, 6.2, 0}, 3), 0.02, 4);
  b.tube(line({1.2, 6.08, 0}, {1.3, 6.4, 0.1}, 3), 0.01, 4);  // on that
  EXPECT_THAT(held(b.mesh), testing::ElementsAre(1, 0, 0));
}

TEST(StemContacts, TheOrderOfTheTrianglesChangesNothing) {
  Builder b = trunk();
  for (int i = 0; i < 40; ++i) {
    const Double3 out{std::cos(i), 0.3, std::sin(i)};
    const Double3 foot{i % 4 == 3 ? 1.5 : 0.0, 1 + i * 0.1, 0};
    b.tube(line(foot, foot + out, 4), 0.04, 5);
  }
  const std::vector<std::uint8_t> before = held(b.mesh);
  EXPECT_EQ(std::ranges::count(before, 1), 31);
  std::vector<std::uint32_t> order(b.mesh.triangles.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::shuffle(order, std::mt19937(1));
  Mesh shuffled = b.mesh;
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    shuffled.triangles[i] = b.mesh.triangles[order[i]], shuffled.part_of[i] = b.mesh.part_of[order[i]];
  }
  EXPECT_EQ(std::ranges::count(held(shuffled), 1), 31);
}

TEST(StemContacts, NothingStandsNothingIsHeld) {
  Builder b = trunk();
  const std::vector<PartVerdict> verdicts(b.mesh.parts.size());
  const std::vector<std::uint32_t> welded = weld(b.mesh.positions, 0.0), keys(b.mesh.parts.size(), 0);
  const PieceScan scan(b.mesh, welded, edge_pieces(b.mesh.triangles, welded, b.mesh.part_of, keys), verdicts);
  EXPECT_THAT(stem_contacts(b.mesh, scan, std::vector<std::uint32_t>{0}, {}), testing::ElementsAre(0));
  EXPECT_TRUE(stem_contacts(b.mesh, scan, {}, {}).empty());
}

}  // namespace
}  // namespace copse
