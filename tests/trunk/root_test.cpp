#include "lib/analysis/trunk/root.h"

#include "lib/analysis/trunk/recover.h"
#include "tests/trunk/tube_maker.h"
#include "tests/trunk/welded_meshes.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace copse {
namespace {

int roots(const Hierarchy& h) {
  int count = 0;
  for (const RadiusNode& r : h.radii) count += r.parent == k_none;
  return count;
}

TEST(Root, BeginsBelowTheGroundWhereThicknessDoesNotTell) {
  TubeMaker maker;
  TubeShape pipe;
  pipe.axis = axis_between({0, 5, 0}, {0, -0.2, 0}, 6);  // read from the top
  pipe.radius = taper_between(0.5, 0.5, 6);
  maker.add(pipe);
  const Hierarchy h = recover_hierarchy(make_trunk_mesh(maker.mesh, all_trunk(maker.mesh)));
  EXPECT_NEAR(h.radii[0].centre.y, -0.2, 1e-12);
}

TEST(Root, StemsThatStandInTheGroundAreRootsEvenWhereTheyOverlap) {
  TubeMaker maker;
  for (int i = 0; i < 4; ++i) {
    TubeShape stem;
    stem.axis = axis_between({0.15 * i, -0.1, 0}, {2.0 * i - 3, 4, 0}, 8);
    stem.radius = taper_between(0.1, 0.02, 8);
    maker.add(stem);
  }
  const Hierarchy h = recover_hierarchy(make_trunk_mesh(maker.mesh, all_trunk(maker.mesh)));
  EXPECT_EQ(roots(h), 4);
}

TEST(Root, TwigsOfABranchThatDroopsBelowTheGroundAreNoRoots) {
  TubeMaker maker;
  TubeShape trunk, branch, twig;
  trunk.axis = axis_between({0, -0.1, 0}, {0, 6, 0}, 8);
  trunk.radius = taper_between(0.3, 0.1, 8);
  maker.add(trunk);
  branch.axis = axis_between({0, 3, 0}, {5, -0.6, 0}, 10);
  branch.radius = taper_between(0.1, 0.04, 10);
  maker.add(branch);
  twig.axis = axis_between({4.7, -0.384, 0}, {5.5, 0.5, 0}, 4);
  twig.radius = taper_between(0.03, 0.01, 4);
  maker.add(twig);
  const Hierarchy h = recover_hierarchy(make_trunk_mesh(maker.mesh, all_trunk(maker.mesh)));
  EXPECT_EQ(roots(h), 1);
}

TEST(Root, TheGroundRuleMeansNothingInAModelThatIsCentredOnTheOrigin) {
  TubeMaker maker;
  TubeShape trunk, branch;
  trunk.axis = axis_between({0, -5, 0}, {0, 5, 0}, 8);
  trunk.radius = taper_between(0.3, 0.1, 8);
  maker.add(trunk);
  branch.axis = axis_between({0, -1, 0}, {3, 2, 0}, 6);
  branch.radius = taper_between(0.1, 0.02, 6);
  maker.add(branch);
  const Hierarchy h = recover_hierarchy(make_trunk_mesh(maker.mesh, all_trunk(maker.mesh)));
  EXPECT_EQ(roots(h), 1);
  EXPECT_NEAR(h.radii[0].centre.y, -5, 1e-12);
}

TubeShape trunk_of(const Double3& from, const Double3& to, double thick, double thin, int rings = 8) {
  TubeShape shape;
  shape.axis = axis_between(from, to, rings);
  shape.radius = taper_between(thick, thin, rings);
  return shape;
}

Hierarchy recover(const TubeMaker& maker, const std::vector<Double3>& roots = {}) {
  return recover_hierarchy(make_trunk_mesh(maker.mesh, all_trunk(maker.mesh)), {.roots = roots});
}

// A cactus, a bottle tree, a lollipop.
TEST(Root, ATrunkThatWidensUpwardStandsOnItsLowerEnd) {
  for (const double y : {-0.3, 0.0, 7.0}) {
    for (const int rings : {2, 8}) {
      TubeMaker maker;
      maker.add(trunk_of({0, y, 0}, {0, y + 4, 0}, 0.1, 0.28, rings));
      maker.add(trunk_of({0, y + 2, 0}, {1, y + 3, 0}, 0.05, 0.09));
      maker.add(trunk_of({0, y + 3.9, 0}, {1, y + 4.5, 0}, 0.06, 0.02));  // from the top
      const Hierarchy h = recover(maker);
      EXPECT_EQ(roots(h), 1);
      EXPECT_NEAR(h.radii[0].centre.y, y, 1e-12) << rings;
    }
  }
}

TEST(Root, WhatHangsDownFromTheGroundBeginsAtItsThickEnd) {
  TubeMaker maker;
  maker.add(trunk_of({0, 0, 0}, {0, -4, 0}, 0.3, 0.05));
  EXPECT_NEAR(recover(maker).radii[0].centre.y, 0, 1e-12);
}

TEST(Root, ALogThatLiesBeginsAtItsThickEnd) {
  TubeMaker maker;
  maker.add(trunk_of({0, 0.31, 0}, {6, 0.3, 0}, 0.3, 0.28));
  EXPECT_NEAR(recover(maker).radii[0].centre.x, 0, 1e-12);
}

TEST(Root, BranchesOfALogThatLiesAreNoRoots) {
  for (const double y : {0.3, 5.0}) {
    TubeMaker maker;
    maker.add(trunk_of({0, y, 0}, {7, y, 0}, 0.3, 0.2));
    for (int i = 0; i < 4; ++i) {
      const double x = 1.2 + 1.4 * i;
      maker.add(trunk_of({x, y, 0.04 * i}, {x + 0.2, y + 2, 0.3}, 0.08, 0.03));
    }
    const Hierarchy h = recover(maker);
    EXPECT_EQ(roots(h), 1) << y;
    EXPECT_NEAR(h.radii[0].centre.x, 0, 1e-12) << y;
  }
}

// A rod that is much thinner than the flared base of what hangs from its middle.
TEST(Root, AFlaredTwigIsHeldByTheMiddleOfAThinnerRod) {
  TubeMaker maker;
  maker.add(trunk_of({0, -0.1, 0}, {0, 6, 0}, 0.3, 0.1));
  maker.add(trunk_of({0, 5, 0}, {4, 5, 0}, 0.04, 0.04));
  TubeShape twig = trunk_of({2, 5, 0}, {2, 3, 0.2}, 0.03, 0.03);
  twig.radius.front() = 0.055;
  twig.last = TubeEnd::point;
  maker.add(twig, 1);
  const Hierarchy h = recover(maker);
  EXPECT_EQ(roots(h), 1);
  const auto base = std::ranges::find_if(h.radii, [](const RadiusNode& r) {
    return r.diameter > 0.105 && r.diameter < 0.115 && r.centre.x > 1;
  });
  ASSERT_NE(base, h.radii.end());
  EXPECT_TRUE(base->joint);
}

TEST(Root, ATwigIsHeldByTheTipOfAThinnerBough) {
  for (const double share : {0.9, 0.7, 0.55}) {
    TubeMaker maker;
    maker.add(trunk_of({0, -0.1, 0}, {0, 6, 0}, 0.3, 0.1));
    maker.add(trunk_of({0, 4, 0}, {4, 4.5, 0}, 0.08, 0.04 * share));
    maker.add(trunk_of({4, 4.5, 0}, {5, 4.3, 0.2}, 0.04, 0.04));
    EXPECT_EQ(roots(recover(maker)), 1) << share;
  }
}

TEST(Root, ABranchThatFloatsALittleBeginsAtItsThickEndHoweverItHangs) {
  TubeMaker maker;
  maker.add(trunk_of({0, -0.1, 0}, {0, 6, 0}, 0.3, 0.1));
  maker.add(trunk_of({0.45, 4, 0}, {3, 2, 0}, 0.08, 0.02));
  const Hierarchy h = recover(maker);
  EXPECT_EQ(roots(h), 1);
  const auto joint = std::ranges::find(h.radii, true, &RadiusNode::joint);
  ASSERT_NE(joint, h.radii.end());
  EXPECT_NEAR(joint->centre.x, 0.45, 1e-12);
}

// Eleven cells high, with arms as thick as the trunk.
TEST(Root, AWeldedTreeOfEvenThicknessStandsOnItsLowestEnd) {
  for (const double y : {0.0, -0.5, 20.0}) {
    TrunkMesh mesh = smooth_cells(std::vector<Cell>{{0, 0, 0},
                                                    {0, 1, 0},
                                                    {0, 2, 0},
                                                    {0, 3, 0},
                                                    {0, 4, 0},
                                                    {0, 5, 0},
                                                    {1, 3, 0},
                                                    {2, 3, 0},
                                                    {2, 2, 0},
                                                    {-1, 5, 0},
                                                    {-2, 5, 0},
                                                    {0, 4, 1},
                                                    {0, 4, 2}},
                                  0);
    for (Double3& p : mesh.positions) p.y += y;
    const Hierarchy h = recover_hierarchy(mesh);
    EXPECT_EQ(roots(h), 1);
    EXPECT_NEAR(h.radii[0].centre.y, y, 1e-12);
    EXPECT_NEAR(h.radii[0].centre.x, 0.5, 1e-12);
  }
}

TEST(Root, IsWhereItIsSaidToBe) {
  TubeMaker maker;
  maker.add(trunk_of({0, -0.1, 0}, {0, 6, 0}, 0.3, 0.1));
  maker.add(trunk_of({9, -0.1, 0}, {9, 6, 0}, 0.3, 0.1));
  maker.add(
      trunk_of({0.31, -0.2, 0}, {3, 3, 0}, 0.06, 0.02));  // stands in the ground, but sprouts from the first
  EXPECT_EQ(roots(recover(maker)), 3);
  const Hierarchy h = recover(maker, {{0, 8, 0}, {9, 0, 1}});
  EXPECT_EQ(roots(h), 2);
  EXPECT_NEAR(h.radii[0].centre.y, 6, 1e-12);
  const Hierarchy twice = recover(maker, {{0, 8, 0}, {0, 0, 0}});
  EXPECT_NEAR(twice.radii[0].centre.y, 6, 1e-12);
  EXPECT_TRUE(std::ranges::any_of(
      twice.notes, [](const std::string& n) { return n.find("root 0,0,0") != std::string::npos; }));
}

}  // namespace
}  // namespace copse
