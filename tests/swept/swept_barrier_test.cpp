#include "lib/analysis/swept/swept_barrier.h"

#include "lib/analysis/swept/swept_descent.h"
#include "tests/volumes/point_sets.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(SweptBarrier, DescentFindsTheSmallestCircleOfAProjection) {
  // An equilateral prism along x: its axis is already that of the thinnest cylinder.
  Points p;
  for (const double x : {-2.0, 2.0}) {
    for (int k = 0; k < 3; ++k) {
      p.push_back({x, std::cos(2 * std::numbers::pi * k / 3), std::sin(2 * std::numbers::pi * k / 3)});
    }
  }
  SweptFit fit{turned(k_world_axes, {0, 0.02, 0.01}), {}};
  fit.rectangle = roomy_rectangle(Swept::line, p, fit.frame);
  descend(Swept::line, p, fit, {1, 1e-10});
  EXPECT_NEAR(fit.rectangle.r, 1, 1e-8);
  EXPECT_NEAR(std::abs(fit.frame[0].x), 1, 1e-6);
}

TEST(SweptBarrier, DescentNeverLosesAPointAndNeverGrows) {
  for (const NamedPoints& s : mixed_sets()) {
    for (const Swept kind : {Swept::line, Swept::capsule, Swept::lozenge}) {
      SweptFit fit{turned(k_world_axes, {0.1, 0.2, -0.3}), {}};
      fit.rectangle = roomy_rectangle(kind, s.points, fit.frame);
      const double before = fit.rectangle.r, volume = fit.volume();
      descend(kind, s.points, fit, {1, 1e-6});
      EXPECT_LE(reach_of(s.points, fit), fit.rectangle.r * (1 + 1e-12)) << s.name;
      if (kind == Swept::line) {
        EXPECT_LE(fit.rectangle.r, before) << s.name;
      } else {
        EXPECT_LE(fit.volume(), volume) << s.name;
      }
    }
  }
}

TEST(SweptBarrier, TheDescentsEndIsStationary) {
  // No small turn or move of the rectangle, with the radius that it then needs, has less volume.
  Random random(3);
  for (const NamedPoints& s : mixed_sets()) {
    const SweptFit best = descend_around(Swept::lozenge, s.points, k_world_axes);
    for (int k = 0; k < 200; ++k) {
      SweptFit near = best;
      const double step = 1e-4 * best.rectangle.r;
      near.frame = turned(best.frame, in_box(random, {step, step, step}));
      SweptRectangle& q = near.rectangle;
      for (double* v : {&q.a0, &q.a1, &q.b0, &q.b1, &q.h}) *v += random.around(0, step);
      if (q.a1 < q.a0 || q.b1 < q.b0) continue;
      q.r = reach_of(s.points, near);
      EXPECT_GE(near.volume(), best.volume() * (1 - 1e-6)) << s.name;
    }
  }
}

TEST(SweptBarrier, SeparationIsZeroWhereTheLengthsHoldThePoints) {
  const Points p = cube_corners();
  Separation problem{{3, 3, 2}, {1, 1, 1}, k_world_axes, {0.01, 0.01, 0.01}};
  SeparationState state;
  state.s = 5;
  separate(Swept::lozenge, p, problem, {1, 1e-9}, state);
  EXPECT_LT(state.s, 1e-6);
}

TEST(SweptBarrier, SeparationMeasuresWhatIsMissing) {
  // A ball about the unit cube needs a radius of sqrt(3) / 2; lengths (0, 0, 0.5) grown by r alone.
  const Points p = cube_corners();
  Separation problem{{0, 0, 0.5}, {0, 0, 1}, k_world_axes, {0.01, 0.01, 0.01}};
  for (const Swept kind : {Swept::capsule, Swept::lozenge}) {
    SeparationState state;
    state.s = 5;
    separate(kind, p, problem, {1, 1e-9}, state);
    // A turn within the cell changes nothing about a ball but by the linearisation, at second order.
    EXPECT_NEAR(state.s, std::sqrt(3.0) / 2 - 0.5, 1e-3);
    Double3 sum;
    double press = 0;
    for (const Double3& f : state.forces) sum += f, press += length(f);
    EXPECT_LT(length(sum), 1e-6);  // the forces balance,
    EXPECT_NEAR(press, 1, 1e-3);   // and weigh as the objective does.
  }
}

}  // namespace
}  // namespace copse
