#include "lib/analysis/rings/taper.h"

#include "tests/trunk/limb_maker.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(Taper, FindsTheEndThatMostStepsTaperFrom) {
  Limbs limbs;
  add_limb(limbs, {0, 0, 0}, {0, 1, 0}, {0.002, 0.1, 0.2, 0.3, 0.4});    // reads from its tip
  add_limb(limbs, {5, 0, 0}, {0, 1, 0}, {0.4, 0.3, 0.2, 0.1, 0.05, 2});  // a flared tip
  add_limb(limbs, {9, 0, 0}, {0, 1, 0}, {1, 1, 1});                      // a pipe
  add_limb(limbs, {12, 0, 0}, {0, 1, 0}, {1, 3, 1});                     // a barrel
  const auto possible = possible_bases(limbs, end_rings(limbs));
  EXPECT_EQ(possible, (std::vector<std::uint8_t>{0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0, 1, 0, 1, 1, 0, 1}));
}

TEST(Taper, ARoundedFootOfATreeMayBeItsBase) {
  Limbs limbs;
  add_limb(limbs, {0, 0, 0}, {0, 1, 0}, {0, 1.3, 1.7, 1.2, 0.4});  // closed by a point below
  limbs.append({{1, 3, 0}, 0.9, {}}, 3, RadiusSource::ring, {});   // a stub at the fork
  limbs.limb.back() = 0;
  const auto possible = possible_bases(limbs, end_rings(limbs));
  EXPECT_EQ(possible, (std::vector<std::uint8_t>{1, 0, 0, 0, 0, 0}));
}

TEST(Taper, TheTipOfAConeIsNoBaseHoweverNarrowTheFoot) {
  Limbs limbs;
  add_limb(limbs, {0, 0, 0}, {0, 1, 0}, {0.6, 0.82, 0.7, 0});   // read from its foot
  add_limb(limbs, {9, 9, 0}, {0, -1, 0}, {0, 0.7, 0.82, 0.6});  // read from its tip
  const auto possible = possible_bases(limbs, end_rings(limbs));
  EXPECT_EQ(possible, (std::vector<std::uint8_t>{1, 0, 0, 0, 0, 0, 0, 1}));
}

TEST(Taper, EndsOfLikeThicknessAreThickWhateverIsBetween) {
  Limbs limbs;
  add_limb(limbs, {0, 0, 0}, {0, 1, 0}, {0.95, 1});
  add_limb(limbs, {5, 0, 0}, {0, 1, 0}, {1, 2, 3, 0.95});
  add_limb(limbs, {9, 0, 0}, {0, 1, 0}, {1, 0.9, 0.8});
  const auto thick = thick_ends(limbs, end_rings(limbs));
  EXPECT_EQ(thick, (std::vector<std::uint8_t>{1, 1, 1, 0, 0, 1, 1, 0, 0}));
}

TEST(Taper, FollowsALimbThroughARootInItsMiddle) {
  Limbs limbs;
  add_limb(limbs, {0, 0, 0}, {0, 1, 0}, {1, 0.9, 0.8});
  add_limb(limbs, {0, 0, 0}, {0, -1, 0}, {1, 1.1, 1.2, 1.3});
  merge_rings(limbs, 0, 3);
  for (std::uint32_t& l : limbs.limb) l = 1;
  const auto possible = possible_bases(limbs, end_rings(limbs));
  EXPECT_EQ(possible, (std::vector<std::uint8_t>{0, 0, 0, 0, 0, 0, 1}));
}

}  // namespace
}  // namespace copse
