#include "lib/formats/volumes/volume_numbers.h"

#include <limits>

#include <gtest/gtest.h>

namespace copse {
namespace {

std::vector<Volume<float>> one_of_each() {
  const Float3 o{1, 2, 3}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  return {FloatBox{o, o + x},
          BoundingSphere<float>{o, 4},
          OrientedBox<float>{o, {x, y, z}, {5, 6, 7}},
          Capsule<float>{o, x, 8},
          Cylinder<float>{o, y, 9},
          Lozenge<float>{o, x, y, 10},
          Ellipsoid<float>{o, {x, y, z}, {3, 2, 1}},
          Kdop<float>{{x, y}, {1, 2}, {3, 4}}};
}

TEST(VolumeNumbers, EveryKindComesBackFromItsNumbers) {
  const auto volumes = one_of_each();
  ASSERT_EQ(volumes.size(), k_volume_kinds);
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    const VolumeKind kind = kind_of(volumes[i]);
    EXPECT_EQ(static_cast<std::size_t>(kind), i);
    const std::vector<float> numbers = numbers_of(volumes[i]);
    EXPECT_TRUE(is_number_count(kind, numbers.size())) << name_of(kind);
    EXPECT_EQ(volume_of(kind, numbers), volumes[i]) << name_of(kind);
    EXPECT_TRUE(is_sound(volumes[i])) << name_of(kind);
    EXPECT_EQ(volume_kind(name_of(kind)), kind);
  }
  EXPECT_FALSE(volume_kind("ball"));
}

TEST(VolumeNumbers, NumbersStandInTheOrderOfTheSpecification) {
  const auto volumes = one_of_each();
  EXPECT_EQ(numbers_of(volumes[3]), (std::vector<float>{1, 2, 3, 1, 0, 0, 8}));
  EXPECT_EQ(numbers_of(volumes[7]), (std::vector<float>{1, 0, 0, 0, 1, 0, 1, 2, 3, 4}));
}

TEST(VolumeNumbers, AWrongCountIsNoVolume) {
  for (std::uint32_t k = 0; k < k_volume_kinds; ++k) {
    EXPECT_FALSE(is_number_count(static_cast<VolumeKind>(k), 0)) << k;
    EXPECT_FALSE(is_number_count(static_cast<VolumeKind>(k), 8)) << k;
  }
}

TEST(VolumeNumbers, WhatHasNoInsideIsNotSound) {
  for (const Volume<float>& volume : one_of_each()) {
    std::vector<float> numbers = numbers_of(volume);
    for (float& n : numbers) {
      const float kept = n;
      n = std::numeric_limits<float>::quiet_NaN();
      EXPECT_FALSE(is_sound(volume_of(kind_of(volume), numbers)));
      n = kept;
    }
    const bool box_or_slab = volume.index() == 0 || volume.index() == 7;
    numbers.back() = box_or_slab ? -100.0f : -1.0f;
    EXPECT_FALSE(is_sound(volume_of(kind_of(volume), numbers))) << volume.index();
  }
  EXPECT_FALSE(is_sound(Cylinder<float>{{1, 1, 1}, {1, 1, 1}, 1}));
  EXPECT_FALSE(is_sound(Kdop<float>{{{0, 0, 0}}, {1}, {2}}));
}

}  // namespace
}  // namespace copse
