#include "lib/analysis/swept/force_plane.h"

#include "lib/analysis/swept/swept_descent.h"
#include "tests/volumes/point_sets.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

double product(const Axes& r, const std::array<Double3, 3>& m) {
  return dot(r[0], m[0]) + dot(r[1], m[1]) + dot(r[2], m[2]);
}

// Random forces, which nothing has made to balance.
ForcePlane random_plane(Random& random, const Points& points) {
  std::vector<std::uint32_t> which;
  std::vector<Double3> forces;
  for (int k = 0; k < 7; ++k) {
    which.push_back(static_cast<std::uint32_t>(random.below(points.size())));
    forces.push_back(in_box(random, {1, 1, 1}));
  }
  return force_plane(points, which, forces);
}

TEST(ForcePlane, HoldsForEveryVolumeAroundThePointsInEveryFrame) {
  Random random(1);
  for (const NamedPoints& s : mixed_sets()) {
    for (int k = 0; k < 200; ++k) {
      const ForcePlane plane = random_plane(random, s.points);
      SweptFit fit{turned(k_world_axes, in_box(random, {1, 1, 1})), {}};
      SweptRectangle& q = fit.rectangle;
      q = {random.around(-1, 1), 0, random.around(-1, 1), 0, random.around(0, 0.5), 0};
      q.a1 = q.a0 + random.uniform(0, 2), q.b1 = q.b0 + random.uniform(0, 2);
      q.r = reach_of(s.points, fit);
      const SweptLengths l = q.lengths();
      EXPECT_GE(plane.alpha * l.a + plane.beta * l.b + plane.gamma * l.r,
                product(fit.frame, plane.moment) - plane.slack - 1e-14)
          << s.name;
    }
  }
}

TEST(ForcePlane, TwoForcesAcrossGiveTheThickness) {
  const Points p{{0, 0, -1}, {0, 0, 3}, {1, 0, 0}};
  const std::vector<std::uint32_t> which{0, 1};
  const std::vector<Double3> forces{{0, 0, -0.5}, {0, 0, 0.5}};
  const ForcePlane plane = force_plane(p, which, forces);
  EXPECT_EQ(plane.alpha, 0);
  EXPECT_EQ(plane.beta, 0);
  EXPECT_EQ(plane.gamma, 1);
  const RotationCell here{k_world_axes, {}, {}};
  EXPECT_NEAR(range_over(plane, here).least, 2, 1e-12);  // r >= half of 4
}

TEST(ForcePlane, NothingPressesNothingIsClaimed) {
  const ForcePlane plane =
      force_plane(cube_corners(), std::vector<std::uint32_t>{0}, std::vector<Double3>{{0, 0, 0}});
  EXPECT_EQ(plane.gamma, 0);
  EXPECT_LE(range_over(plane, {k_world_axes, {-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}}).least, 0);
}

TEST(ForcePlane, TheRangeIsBelowEverySampleOfTheCellAndNearTheLeast) {
  Random random(2);
  double worst = 0;
  for (int k = 0; k < 300; ++k) {
    const ForcePlane plane = random_plane(random, icosahedron());
    const double half = std::pow(10.0, random.uniform(-4, -0.5));
    const Double3 centre = in_box(random, {0.4, 0.4, 0.4}), size{half, half * random.uniform(), half};
    const RotationCell cell{turned(k_world_axes, in_box(random, {1, 1, 1})), centre - size, centre + size};
    const double least = range_over(plane, cell).least;
    double sampled = 1e300;
    for (int i = 0; i < 400; ++i) {
      Double3 g = centre;
      for (int c = 0; c < 3; ++c) {  // corners and edges too
        g[c] += size[c] * (random.chance(0.5) ? random.around(0, 1) : random.chance(0.5) ? 1 : -1);
      }
      sampled = std::min(sampled, product(turned(cell.frame, g), plane.moment));
    }
    EXPECT_LE(least, sampled + 1e-13);
    if (half < 1e-2) worst = std::max(worst, (sampled - least) / (half * plane.gamma));
  }
  EXPECT_LT(worst, 0.5);  // what is given away is of second order in the size of the cell
}

TEST(ForcePlane, SlackIsAFewRoundings) {
  Random random(3);
  const ForcePlane plane = random_plane(random, cube_corners());
  EXPECT_GT(plane.slack, 0);
  EXPECT_LT(plane.slack, 1e-12 * plane.gamma);
}

}  // namespace
}  // namespace copse
