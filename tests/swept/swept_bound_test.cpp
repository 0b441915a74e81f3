#include "lib/analysis/swept/swept_bound.h"

#include "lib/analysis/swept/swept_search.h"
#include "tests/volumes/hull_of.h"
#include "tests/volumes/point_sets.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(SweptBound, IsBelowEveryVolumeThatAnyoneFinds) {
  Random random(1);
  for (const NamedPoints& s : mixed_sets()) {
    for (const Swept kind : {Swept::capsule, Swept::lozenge}) {
      SweptFit best = search_around(kind, s.points);
      const SweptBound bound = bound_swept(kind, s.points, {0.02, 300}, best);
      EXPECT_LE(bound.lower_bound, best.volume()) << s.name;
      for (int k = 0; k < 4; ++k) {
        const Axes start = turned(k_world_axes, in_box(random, {1, 1, 1}));
        EXPECT_LE(bound.lower_bound, descend_around(kind, s.points, start).volume()) << s.name;
      }
    }
  }
}

TEST(SweptBound, ReachesItsGapOnEverySetThatIsNotThinnerThanRounding) {
  for (const NamedPoints& s : mixed_sets()) {
    for (const Swept kind : {Swept::capsule, Swept::lozenge}) {
      SweptFit best = search_around(kind, s.points);
      const SweptBound bound = bound_swept(kind, s.points, {0.12, 20000}, best);
      EXPECT_LE(best.volume(), bound.lower_bound * 1.12 * (1 + 1e-12)) << s.name << ' ' << bound.separations;
    }
  }
}

TEST(SweptBound, ProvesKnownOptima) {
  const auto gap = [](Swept kind, const Points& points, double wanted) {
    SweptFit best = search_around(kind, points);
    const SweptBound bound = bound_swept(kind, points, {wanted, 30000}, best);
    return best.volume() / bound.lower_bound - 1;
  };
  // A ball is the least volume around an icosahedron.
  const double ball = 4.0 / 3.0 * std::numbers::pi * std::pow(1 + std::numbers::phi * std::numbers::phi, 1.5);
  SweptFit best = search_around(Swept::capsule, icosahedron());
  const SweptBound bound = bound_swept(Swept::capsule, icosahedron(), {0.01, 30000}, best);
  EXPECT_LE(bound.lower_bound, ball);
  EXPECT_GE(bound.lower_bound, ball / 1.0101);
  EXPECT_LE(gap(Swept::capsule, cube_corners(), 0.005), 0.005001);
  EXPECT_LE(gap(Swept::lozenge, cube_corners(), 0.01), 0.010001);
  EXPECT_LE(gap(Swept::lozenge, corner_tetrahedron(), 0.01), 0.010001);
}

TEST(SweptBound, FindsTheOptimumFromAPoorStart) {
  for (const Swept kind : {Swept::capsule, Swept::lozenge}) {
    const Points p = corner_tetrahedron();
    SweptFit poor{k_world_axes, roomy_rectangle(kind, p, k_world_axes)};
    poor.rectangle.r *= 1.5;
    const double start = poor.volume();
    bound_swept(kind, p, {0.01, 30000}, poor);
    EXPECT_LE(poor.volume(), search_around(kind, p).volume() * 1.0101);
    EXPECT_LT(poor.volume(), start);
    EXPECT_LE(reach_of(p, poor), poor.rectangle.r);
  }
}

TEST(SweptBound, OfAVolumesOwnSurfaceComesNearItsVolume) {
  SweptFit best = search_around(Swept::capsule, capsule_samples());
  const SweptBound bound = bound_swept(Swept::capsule, capsule_samples(), {0.01, 30000}, best);
  EXPECT_GE(bound.lower_bound, swept_volume({1, 0, 0.2}) * 0.96);  // 600 samples leave a little of it out
  EXPECT_LE(bound.lower_bound, swept_volume({1, 0, 0.2}));
}

TEST(SweptBound, HoldsForNeedlesThinnerThanItCanProveMuchAbout) {
  Random random(6);
  for (const double thin : {1e-6, 1e-9, 1e-12, 1e-14}) {
    const Points p = repeated(40, [&] { return in_box(random, {1, thin, thin}); });
    for (const Swept kind : {Swept::capsule, Swept::lozenge}) {
      SweptFit best = search_around(kind, p);
      const SweptBound bound = bound_swept(kind, p, {0.1, 300}, best);
      EXPECT_GE(bound.lower_bound, 0);
      EXPECT_LE(bound.lower_bound, best.volume());
      // In no frame can it be thinner than half the largest distance across the axis of some two points.
      EXPECT_LE(bound.lower_bound, swept_volume({2, 0, 2 * thin}));
    }
  }
}

TEST(SweptBound, ProvesATenthOfNeedlesInWorkThatGrowsWithTheLogarithmOfTheirAspect) {
  for (const double aspect : {1e3, 1e4, 1e5, 1e6}) {
    Random random(6);
    Points p = repeated(60, [&] { return in_box(random, {1, 1 / aspect, 1 / aspect}); });
    const Axes frame = turned(k_world_axes, in_box(random, {1, 1, 1}));
    for (Double3& q : p) q = into(frame, q);
    const ConvexHull hull = hull_of(p);
    SweptFit best = search_around(Swept::lozenge, hull.vertices);
    SweptBoundOptions options;
    options.gap = 0.1, options.max_separations = 5000, options.least_radius = inner_radius(hull);
    const SweptBound bound = bound_swept(Swept::lozenge, hull.vertices, options, best);
    EXPECT_LE(best.volume(), bound.lower_bound * 1.1001) << aspect;
    EXPECT_LE(static_cast<double>(bound.separations), 700 * std::log10(aspect)) << aspect;
  }
}

TEST(SweptBound, ALimitOfWorkGivesTheSameBitsAgainAndAProofStill) {
  const Points p = torus();
  SweptFit a = search_around(Swept::lozenge, p), b = a;
  const SweptBound x = bound_swept(Swept::lozenge, p, {0.001, 100}, a);
  const SweptBound y = bound_swept(Swept::lozenge, p, {0.001, 100}, b);
  EXPECT_EQ(x.lower_bound, y.lower_bound);
  EXPECT_EQ(a.rectangle.r, b.rectangle.r);
  EXPECT_LE(x.separations, 100u);
  EXPECT_GT(x.lower_bound, 0);
  EXPECT_LE(x.lower_bound, 0.35435676);
}

TEST(SweptBound, ALimitOfTimeEndsIt) {
  SweptFit best = search_around(Swept::lozenge, torus());
  const SweptBound bound =
      bound_swept(Swept::lozenge, torus(), {0, std::size_t(1) << 40, Deadline::after(0.02)}, best);
  EXPECT_LE(bound.lower_bound, best.volume());
  EXPECT_LT(bound.separations, 100000u);
}

}  // namespace
}  // namespace copse
