#include "lib/analysis/trunk/root.h"

#include "lib/analysis/trunk/recover.h"
#include "tests/trunk/tube_maker.h"

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

}  // namespace
}  // namespace copse
