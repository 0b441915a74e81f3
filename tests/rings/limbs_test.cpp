#include "lib/analysis/rings/limbs.h"

#include "tests/trunk/limb_maker.h"

#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(Limbs, RerootTurnsRoundTheWayAndKeepsTheBands) {
  Limbs limbs;
  add_limb(limbs, {0, 0, 0}, {0, 1, 0}, {1, 1, 1, 1});
  reroot(limbs, 2);
  EXPECT_EQ(limbs.parent, (std::vector<std::uint32_t>{1, 2, k_none, 2}));
  EXPECT_EQ(limbs.band, (std::vector<std::uint32_t>{1, 2, k_none, 3}));
  reroot(limbs, 0);
  EXPECT_EQ(limbs.parent, (std::vector<std::uint32_t>{k_none, 0, 1, 2}));
  EXPECT_EQ(limbs.band, (std::vector<std::uint32_t>{k_none, 1, 2, 3}));
}

TEST(Limbs, MeasuresARingFarFromTheOriginAndAtAnySize) {
  for (const double scale : {1.0, 1e-30, 1e30}) {
    for (const double offset : {0.0, 1e7}) {
      std::vector<Double3> p;
      for (int j = 0; j < 4; ++j) p.push_back(Double3{offset + (j % 2), offset + j / 2, 0.0} * scale);
      const RingMeasure m = measure_ring(p, std::vector<std::uint32_t>{0, 1, 2, 3});
      EXPECT_NEAR(m.diameter / scale, std::sqrt(2.0), 1e-8);
      EXPECT_NEAR(m.centre.x / scale - offset, 0.5, 1e-8);
    }
  }
}

}  // namespace
}  // namespace copse
