#include "lib/analysis/ecosystem/disc_cover.h"

#include "lib/formats/random.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace copse {
namespace {

const Patch k_patch{10, 20, 2, 1};

bool in_any(const std::vector<Disc>& discs, double x, double z, double growth, double slack) {
  return std::any_of(discs.begin(), discs.end(),
                     [&](const Disc& d) { return std::hypot(x - d.x, z - d.z) < d.radius + growth + slack; });
}

// Of a fine grid of places.
bool has_open_place(const std::vector<Disc>& discs, double growth, double slack) {
  for (int r = 0; r <= 80; ++r)
    for (int c = 0; c <= 160; ++c)
      if (!in_any(discs, 10 + c / 80.0, 20 + r / 80.0, growth, slack)) return true;
  return false;
}

TEST(DiscCover, NothingCoversNothing) {
  EXPECT_FALSE(is_covered(k_patch, {}, 1));
  const auto middle = open_middle(k_patch, {}, 1);
  ASSERT_TRUE(middle);
  EXPECT_DOUBLE_EQ(middle->x, 11);
  EXPECT_DOUBLE_EQ(middle->z, 20.5);
}

TEST(DiscCover, OneDiscDoesWhereItReachesEveryCorner) {
  const double reach = std::hypot(1, 0.5);
  EXPECT_TRUE(is_covered(k_patch, std::vector<Disc>{{11, 20.5, 0.2}}, reach - 0.2 + 1e-6));
  EXPECT_FALSE(is_covered(k_patch, std::vector<Disc>{{11, 20.5, 0.2}}, reach - 0.2 - 1e-6));
  EXPECT_FALSE(is_covered(k_patch, std::vector<Disc>{{11, 20.5, 0.2}}, 0));  // a hole round a disc inside
}

TEST(DiscCover, TwoHalvesCoverTheWholeAndTheSeamDecides) {
  const double reach = std::hypot(0.5, 0.5);
  const std::vector<Disc> halves{{10.5, 20.5, 0}, {11.5, 20.5, 0}};
  EXPECT_TRUE(is_covered(k_patch, halves, reach));  // touching corners leave nothing open
  EXPECT_TRUE(is_covered(k_patch, halves, reach + 1e-6));
  EXPECT_FALSE(is_covered(k_patch, halves, reach - 1e-6));
}

// Three discs round an opening between them, as small as it may be.
TEST(DiscCover, TheSmallestOpeningBetweenThreeIsFound) {
  std::vector<Disc> round;
  for (const double angle : {0.3, 2.4, 4.5})
    round.push_back({11 + std::cos(angle), 20.5 + std::sin(angle), 0.5});
  const Patch inside{10.9, 20.4, 0.2, 0.2};
  for (const double narrow : {1e-2, 1e-4, 1e-6}) {
    const auto middle = open_middle(inside, round, 0.5 - narrow);
    ASSERT_TRUE(middle) << narrow;
    EXPECT_FALSE(in_any(round, middle->x, middle->z, 0.5 - narrow, 0)) << narrow;
    EXPECT_NEAR(middle->x, 11, 4 * narrow);
  }
  EXPECT_TRUE(is_covered(inside, round, 0.5 + 1e-6));
  EXPECT_FALSE(open_middle(inside, round, 0.5 + 1e-6));
}

TEST(DiscCover, AgreesWithAFineGridOfPlacesOnRandomDiscs) {
  Random random(7);
  int covered = 0;
  for (int n = 0; n < 400; ++n) {
    std::vector<Disc> discs;
    const int count = 1 + n % 12;
    for (int i = 0; i < count; ++i)
      discs.push_back({random.uniform(9, 13), random.uniform(19, 22), random.uniform(0, 0.6)});
    const double growth = random.uniform(0.1, 1.2);
    const bool told = is_covered(k_patch, discs, growth);
    covered += told;
    EXPECT_EQ(told, !open_middle(k_patch, discs, growth).has_value()) << n;
    if (told)
      EXPECT_FALSE(has_open_place(discs, growth, 1e-8)) << n;
    else
      EXPECT_TRUE(has_open_place(discs, growth, -0.02)) << n;  // the grid's places are 1/80 apart
  }
  EXPECT_GT(covered, 60);
  EXPECT_LT(covered, 340);
}

TEST(DiscCover, FarFromTheOriginAsWell) {
  Random random(3);
  for (int n = 0; n < 50; ++n) {
    std::vector<Disc> here, far;
    for (int i = 0; i < 6; ++i) {
      const Disc d{10 + random.below(192) / 64.0, 20 + random.below(128) / 64.0, random.below(64) / 64.0};
      here.push_back(d);
      far.push_back({d.x + 0x1p24, d.z - 0x1p24, d.radius});
    }
    EXPECT_EQ(is_covered(k_patch, here, 0.5), is_covered({10 + 0x1p24, 20 - 0x1p24, 2, 1}, far, 0.5)) << n;
  }
}

}  // namespace
}  // namespace copse
