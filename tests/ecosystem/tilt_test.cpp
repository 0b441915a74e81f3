#include "lib/analysis/ecosystem/tilt.h"

#include "lib/formats/ecosystem/instance_codec.h"
#include "lib/formats/random.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace copse {
namespace {

Double3 random_normal(Random& random) {
  return upward({random.uniform(-1, 1), random.uniform(0, 1), random.uniform(-1, 1)});
}

TEST(Tilt, TheRotationTakesUpExactlyToTheNormal) {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const Double3 n = random_normal(random);
    const Quaternion q = tilt_to(n);
    EXPECT_LT(distance(rotate(q, {0, 1, 0}), n), 1e-15);
    // Head spins about the trunk: it does not move +Y (erratum E4).
    EXPECT_LT(distance(rotate(with_head(q, random.uniform(-1e6, 1e6)), {0, 1, 0}), n), 2e-15);
  }
}

TEST(Tilt, StoredExactlyItStaysWithinAMillionth) {
  Random random(2);
  InstanceBlock block;
  for (int i = 0; i < 20000; ++i) {
    const Double3 n = random_normal(random);
    Instance instance{.position = {}, .rotation = with_head(tilt_to(n), random.uniform(0, 360))};
    const Instance back = unpack(pack_exactly(instance, block), block);
    EXPECT_LT(distance(rotate(back.rotation, {0, 1, 0}), n), 1e-6);
  }
}

TEST(Tilt, TheOraclesOfTheDigestHold) {
  const double third = 1 / std::sqrt(3.0);
  const Angles a = angles_of(tilt_to({third, third, third}));
  EXPECT_NEAR(a.roll, -45, 1e-10);
  EXPECT_NEAR(a.pitch, 35.264389682754654, 1e-10);
  EXPECT_EQ(angles_of(tilt_to({0, 1, 0})).roll, 0);
  const Angles flat = angles_of(tilt_to({1, 0, 0}));
  EXPECT_NEAR(flat.roll, -90, 1e-10);
  EXPECT_NEAR(flat.pitch, 0, 1e-10);
}

TEST(Tilt, AnglesGiveTheRotationBack) {
  Random random(3);
  for (int i = 0; i < 5000; ++i) {
    const Quaternion q = with_head(tilt_to(random_normal(random)), random.uniform(-720, 720));
    const Angles a = angles_of(q);
    EXPECT_GT(a.head, -180.0000001);
    EXPECT_LE(a.head, 180);
    const Quaternion back = with_head(tilt_of(a.pitch, a.roll), a.head);
    double dot = 0;
    for (std::size_t k = 0; k < 4; ++k) dot += q[k] * back[k];
    EXPECT_NEAR(std::abs(dot), 1, 1e-14);
  }
}

TEST(Tilt, TheTwoAnglesOfTheThesisAreExactOnlyAlongAnAxis) {
  EXPECT_NEAR(thesis_tilt_error(upward({0.3, 1, 0})), 0, 1e-12);
  EXPECT_NEAR(thesis_tilt_error(upward({0, 1, -0.7})), 0, 1e-12);
  EXPECT_NEAR(thesis_tilt_error(upward({.2, 1, .2})), 0.21, 0.01);  // erratum E3
  EXPECT_NEAR(thesis_tilt_error(upward({.5, 1, .5})), 2.5, 0.1);
  EXPECT_NEAR(thesis_tilt_error(upward({1, 1, 1})), 9.7, 0.1);
  EXPECT_NEAR(thesis_tilt_error(upward({1, .1, 1})), 39, 0.5);
}

TEST(Tilt, NormalsThatAreNoneStandUpright) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(upward({0, 0, 0}), (Double3{0, 1, 0}));
  EXPECT_EQ(upward({nan, 1, 0}), (Double3{0, 1, 0}));
  EXPECT_EQ(upward({0, -2, 0}), (Double3{0, 1, 0}));
  EXPECT_NEAR(upward({1e300, 1e300, 0}).x, std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(upward({1e-300, 1e-300, 0}).y, std::sqrt(0.5), 1e-15);
}

TEST(Tilt, LeaningOverKeepsTheHead) {
  Random random(11);
  for (int i = 0; i < 2000; ++i) {
    const Double3 from = random_normal(random), to = random_normal(random);
    const double head = random.uniform(-180, 180);
    const Quaternion there = leaned(with_head(tilt_to(from), head), to);
    EXPECT_LT(distance(rotate(there, {0, 1, 0}), to), 1e-14);
    const Quaternion wanted = with_head(tilt_to(to), head);
    for (const Double3& v : {Double3{1, 0, 0}, {0, 0, 1}})
      EXPECT_LT(distance(rotate(there, v), rotate(wanted, v)), 1e-13);
  }
}

}  // namespace
}  // namespace copse
