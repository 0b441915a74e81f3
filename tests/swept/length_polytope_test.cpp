#include "lib/analysis/swept/length_polytope.h"

#include "lib/formats/random.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

struct Cut {
  double alpha, beta, gamma, least;
};

TEST(LengthPolytope, UncutIsLeastAtTheOrigin) {
  const LengthPolytope p(Swept::lozenge, {1, 1, 1});
  EXPECT_EQ(swept_volume(p.least()), 0);
  EXPECT_EQ(p.least_volume(), 0);
}

TEST(LengthPolytope, ARadiusAloneGivesTheBall) {
  for (const Swept kind : {Swept::capsule, Swept::lozenge}) {
    LengthPolytope p(kind, {2, 2, 2});
    EXPECT_TRUE(p.cut(0, 0, 1, 0.5));
    EXPECT_NEAR(p.least_volume(), swept_volume({0, 0, 0.5}), 1e-12);
    EXPECT_LE(p.least_volume(), swept_volume({0, 0, 0.5}));
    EXPECT_TRUE(p.supports_least(0));
  }
}

TEST(LengthPolytope, LengthAndRadiusGiveTheCapsule) {
  LengthPolytope p(Swept::capsule, {9, 9, 9});
  p.cut(0, 0, 1, 0.5), p.cut(1, 0, 0, 3);
  EXPECT_NEAR(p.least().a, 3, 1e-12);
  EXPECT_NEAR(p.least().r, 0.5, 1e-12);
}

TEST(LengthPolytope, NoLengthsCanSatisfyAllIsEmpty) {
  LengthPolytope p(Swept::lozenge, {1, 1, 1});
  p.cut(0, 0, 1, 2);
  EXPECT_TRUE(p.empty());
  EXPECT_EQ(p.least_volume(), std::numeric_limits<double>::infinity());
}

TEST(LengthPolytope, LeastIsBelowEverySampleAndReachedByOne) {
  Random random(1);
  for (int round = 0; round < 100; ++round) {
    const Swept kind = round % 2 ? Swept::capsule : Swept::lozenge;
    const bool thin = round % 3 == 0;
    LengthPolytope p(kind, {2, 2, 1});
    std::vector<Cut> cuts;
    for (int k = 0; k < 8; ++k) {
      const Cut c{random.uniform(), random.uniform(), random.uniform() * (thin ? 50 : 1),
                  random.uniform(0.1, 1)};
      cuts.push_back(c);
      EXPECT_TRUE(p.cut(c.alpha, c.beta, c.gamma, c.least));
    }
    const auto satisfied = [&](const SweptLengths& l, double slack) {
      for (const Cut& c : cuts) {
        if (c.alpha * l.a + c.beta * l.b + c.gamma * l.r < c.least - slack) return false;
      }
      return true;
    };
    if (p.empty()) continue;
    EXPECT_TRUE(satisfied(p.least(), 1e-12));
    for (int i = 0; i < 2000; ++i) {
      const SweptLengths l{random.uniform(0, 2), kind == Swept::lozenge ? random.uniform(0, 2) : 0,
                           random.uniform()};
      if (satisfied(l, 0)) {
        EXPECT_GE(swept_volume(l), p.least_volume());
      }
    }
  }
}

TEST(LengthPolytope, RefusesMoreCutsThanItCanTell) {
  LengthPolytope p(Swept::lozenge, {1, 1, 1});
  for (int k = 0; k < LengthPolytope::k_most_cuts; ++k) EXPECT_TRUE(p.cut(1, 1, 1, 0.001 * k));
  const double before = p.least_volume();
  EXPECT_FALSE(p.cut(0, 0, 1, 0.9));
  EXPECT_EQ(p.least_volume(), before);
}

TEST(LengthPolytope, TheVolumesCubeRootIsConcave) {  // why vertices are enough
  Random random(2);
  const auto root = [](const SweptLengths& l) { return std::cbrt(swept_volume(l)); };
  for (int k = 0; k < 10000; ++k) {
    const auto lengths = [&] { return SweptLengths{random.uniform(), random.uniform(), random.uniform()}; };
    const SweptLengths p = lengths(), q = lengths();
    const double t = random.uniform(), s = 1 - t;
    const SweptLengths m{p.a * t + q.a * s, p.b * t + q.b * s, p.r * t + q.r * s};
    EXPECT_GE(root(m), (root(p) * t + root(q) * s) * (1 - 1e-14));
  }
}

}  // namespace
}  // namespace copse
