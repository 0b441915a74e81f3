#include "lib/analysis/surface/weld.h"

#include "lib/analysis/surface/tolerances.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace copse {
namespace {

using Ids = std::vector<std::uint32_t>;

TEST(Weld, JoinsEqualPositionsToTheLowestIndexEvenWithoutTolerance) {
  const std::vector<Double3> p{{1, 2, 3}, {0, 0, 0}, {1, 2, 3}, {-0.0, 0, -0.0}, {1, 2, 3}};
  EXPECT_EQ(weld(p, 0), (Ids{0, 1, 0, 1, 0}));
}

TEST(Weld, KeepsPointsThatAreFartherApartThanTheTolerance) {
  const std::vector<Double3> p{{0, 0, 0}, {1.001, 0, 0}, {0, 0.999, 0}};
  EXPECT_EQ(weld(p, 1), (Ids{0, 1, 0}));
}

TEST(Weld, NeverChainsThroughAnIntermediatePoint) {
  const std::vector<Double3> p{{0, 0, 0}, {0.9, 0, 0}, {1.8, 0, 0}, {2.7, 0, 0}};
  EXPECT_EQ(weld(p, 1), (Ids{0, 0, 2, 2}));
}

TEST(Weld, TakesTheSmallerToleranceOfTwoPoints) {
  const std::vector<Double3> p{{0, 0, 0}, {0.5, 0, 0}, {10, 0, 0}, {10.5, 0, 0}};
  EXPECT_EQ(weld(p, std::vector<double>{1, 1e-3, 1, 1}), (Ids{0, 1, 2, 2}));
  EXPECT_EQ(weld(p, std::vector<double>{1e-3, 1, 1, 1}), (Ids{0, 1, 2, 2}));
}

TEST(Weld, HandlesNothingAndOnePointAndAllEqual) {
  EXPECT_TRUE(weld(std::vector<Double3>{}, 1).empty());
  EXPECT_EQ(weld(std::vector<Double3>{{1, 1, 1}}, 1), (Ids{0}));
  EXPECT_EQ(weld(std::vector<Double3>(5, {7, 7, 7}), 0), (Ids{0, 0, 0, 0, 0}));
}

RC_GTEST_PROP(Weld, AgreesWithTheQuadraticDefinition, ()) {
  const int n = *rc::gen::inRange(0, 120);
  std::vector<Double3> p;
  std::vector<double> tolerances;
  const auto lattice = [] { return *rc::gen::inRange(-12, 12) * 0.37; };
  for (int i = 0; i < n; ++i) {
    p.push_back({lattice(), lattice(), lattice() * 0.1});
    tolerances.push_back(std::ldexp(*rc::gen::inRange(1, 8), *rc::gen::inRange(-6, 2)));
  }
  const Ids got = weld(p, tolerances);
  for (std::uint32_t i = 0; i < p.size(); ++i) {
    std::uint32_t want = i;
    for (std::uint32_t j = 0; j < i; ++j) {
      if (p[j] == p[i]) {
        want = got[j];
        break;
      }
    }
    for (std::uint32_t j = 0; j < i && want == i; ++j) {
      if (got[j] == j && distance(p[i], p[j]) <= std::min(tolerances[i], tolerances[j])) want = j;
    }
    RC_ASSERT(got[i] == want);
  }
}

// A ring of k vertices whose seam vertex is repeated with rounding noise, as a band of triangles to `other`.
TEST(Weld, MeshTolerancesCloseSeamsButKeepATwigOfATenThousandthOfTheHeight) {
  for (const double scale : {1.0, 1e-30, 1e30}) {
    std::vector<Double3> p{{0, 0, 0}, {0, 10 * scale, 0}};
    std::vector<Triangle> t{{0, 1, 0}};
    const int k = 40;
    for (int ring = 0; ring < 2; ++ring) {
      for (int j = 0; j <= k; ++j) {
        const double a = 2 * std::numbers::pi * j / k, r = 1e-3 * scale;
        const auto stored = [](double x) { return static_cast<double>(static_cast<float>(x)); };
        p.push_back({stored(r * std::cos(a)), stored((9.9 + 0.01 * ring) * scale), stored(r * std::sin(a))});
      }
    }
    for (std::uint32_t j = 0; j < k; ++j) {
      const std::uint32_t a = 2 + j, b = a + k + 1;
      t.push_back({a, a + 1, b});
      t.push_back({a + 1, b + 1, b});
    }
    const Ids rep = weld(p, weld_tolerances(p, t));
    for (std::uint32_t v = 0; v < p.size(); ++v) {
      const bool seam = v == 2 + k || v == 2 + 2 * k + 1;
      EXPECT_EQ(rep[v], seam ? v - k : v) << "scale " << scale;
    }
  }
}

TEST(Weld, MeshTolerancesAreZeroWhereNothingIsUsedOrDifferencesOverflow) {
  const std::vector<Double3> p{{-1.7e308, 0, 0}, {1.7e308, 0, 0}, {0, 1.7e308, 0}, {5, 5, 5}};
  const std::vector<double> t = weld_tolerances(p, std::vector<Triangle>{{0, 1, 2}});
  for (const double x : t) EXPECT_EQ(x, 0);
  EXPECT_EQ(weld(p, t), (Ids{0, 1, 2, 3}));
}

TEST(Weld, AStrayTriangleFarAwayDoesNotSwallowTheTree) {
  std::vector<Double3> p{{1e6, 0, 0}, {1e6 + 1, 0, 0}, {1e6, 1, 0}};
  std::vector<Triangle> t{{0, 1, 2}};
  for (std::uint32_t i = 0; i < 50; ++i) {
    for (std::uint32_t j = 0; j < 50; ++j) p.push_back({0.1 * i, 0.1 * j, 0});
  }
  for (std::uint32_t v = 3; v + 51 < p.size(); ++v) t.push_back({v, v + 1, v + 50});
  const Ids rep = weld(p, weld_tolerances(p, t));
  for (std::uint32_t v = 0; v < p.size(); ++v) EXPECT_EQ(rep[v], v);
}

}  // namespace
}  // namespace copse
