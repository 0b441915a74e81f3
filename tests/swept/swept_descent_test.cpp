#include "lib/analysis/swept/swept_descent.h"

#include "tests/volumes/point_sets.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(SweptDescent, EnclosesEveryPointOfEverySet) {
  for (const auto& sets : {mixed_sets(), flat_sets()}) {
    for (const NamedPoints& s : sets) {
      for (const Swept kind : {Swept::line, Swept::capsule, Swept::lozenge}) {
        const SweptFit fit = descend_around(kind, s.points, k_world_axes);
        EXPECT_TRUE(std::isfinite(fit.volume())) << s.name;
        EXPECT_LE(reach_of(s.points, fit), fit.rectangle.r) << s.name;
        EXPECT_LE(fit.rectangle.a0, fit.rectangle.a1) << s.name;
        EXPECT_LE(fit.rectangle.b0, fit.rectangle.b1) << s.name;
      }
    }
  }
}

TEST(SweptDescent, RecoversACapsuleFromItsSurface) {
  const SweptFit fit = descend_around(Swept::capsule, capsule_samples(), k_world_axes);
  EXPECT_NEAR(std::abs(dot(fit.frame[0], normalized({1, 2, 3}))), 1, 1e-4);
  EXPECT_LE(fit.volume(), swept_volume({1, 0, 0.2}) * (1 + 1e-7));
}

TEST(SweptDescent, AWorkingSetGivesWhatAllPointsGive) {
  for (const NamedPoints& s : mixed_sets()) {
    const SweptFit few = descend_around(Swept::lozenge, s.points, k_world_axes);
    SweptFit all = few;
    all.rectangle.r *= 1.001;
    descend(Swept::lozenge, s.points, all, {1e-3, 1e-9});
    EXPECT_GE(all.volume(), few.volume() * (1 - 1e-5)) << s.name;
  }
}

TEST(SweptDescent, ExtremePointsAreAFewOfThePoints) {
  const Points p = torus();
  const auto few = extreme_points(p, k_world_axes);
  EXPECT_GE(few.size(), 6u);
  EXPECT_LE(few.size(), 14u);
  EXPECT_TRUE(std::is_sorted(few.begin(), few.end()));
  EXPECT_LT(few.back(), p.size());
}

}  // namespace
}  // namespace copse
