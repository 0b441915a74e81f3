#include "lib/formats/ecosystem/instance_codec.h"

#include "lib/formats/random.h"

#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

Quaternion random_rotation(Random& random) {
  Quaternion q{};
  double square = 0;
  do {
    square = 0;
    for (double& part : q) part = random.uniform(-1, 1), square += part * part;
  } while (square > 1 || square < 0.01);
  for (double& part : q) part /= std::sqrt(square);
  return q;
}

TEST(InstanceCodec, RotationsComeBackWithinTheBound) {
  Random random(1);
  double worst = 0, worst_axis = 0;
  for (int i = 0; i < 200000; ++i) {
    const Quaternion q = random_rotation(random), back = unpack_rotation(pack_rotation(q));
    EXPECT_TRUE(is_packed_rotation(pack_rotation(q)));
    worst_axis = std::max(worst_axis, distance(rotate(q, {0, 1, 0}), rotate(back, {0, 1, 0})));
    double plus = 0, minus = 0;
    for (std::size_t k = 0; k < 4; ++k)
      plus += std::pow(q[k] + back[k], 2), minus += std::pow(q[k] - back[k], 2);
    worst = std::max(worst, 2 * std::sqrt(std::min(plus, minus)));
  }
  EXPECT_LT(worst, k_packed_rotation_error);
  EXPECT_GT(worst, 0.8 * k_packed_rotation_error);  // the bounds are no fantasies
  EXPECT_LT(worst_axis, k_packed_axis_error);
  EXPECT_GT(worst_axis, 0.8 * k_packed_axis_error);
}

TEST(InstanceCodec, NoTurnHalfTurnsAndUpsideDownAreExact) {
  EXPECT_EQ(unpack_rotation(pack_rotation({0, 0, 0, 1})), (Quaternion{0, 0, 0, 1}));
  EXPECT_EQ(unpack_rotation(pack_rotation({0, -1, 0, 0})), (Quaternion{0, 1, 0, 0}));
  for (const Quaternion& q : {Quaternion{1, 0, 0, 0}, {0, 0, 1, 0}}) {
    const Quaternion back = unpack_rotation(pack_rotation(q));
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(std::abs(back[k]), std::abs(q[k]), 1e-15);
  }
}

TEST(InstanceCodec, NextToUpsideDownAndUprightRotationsComeBackAsWell) {
  Random random(5);
  for (int i = 0; i < 20000; ++i) {
    // A half turn about a level axis, or a turn about y, and then a tilt of 1e-12 to 1e-3.
    const double head = random.uniform(-3.2, 3.2), across = random.uniform(0, 7),
                 tilt = std::pow(10, random.uniform(-12, -3));
    const bool down = i % 2 == 0;
    Quaternion q = down ? Quaternion{std::cos(head), 0, std::sin(head), tilt * std::sin(across)}
                        : Quaternion{tilt * std::cos(across), std::sin(head), tilt, std::cos(head)};
    double square = 0;
    for (const double part : q) square += part * part;
    for (double& part : q) part /= std::sqrt(square);
    const Quaternion back = unpack_rotation(pack_rotation(q));
    for (const Double3& v : {Double3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
      EXPECT_LT(distance(rotate(q, v), rotate(back, v)), k_packed_rotation_error);
  }
}

TEST(InstanceCodec, EveryCodeButTheOnesTooManyIsARotation) {
  Random random(6);
  const std::uint64_t axis = (std::uint64_t{1} << k_axis_bits) - 1, head = (1 << k_head_bits) - 1;
  for (int i = 0; i < 20000; ++i) {
    const std::uint64_t code =
        random.below(axis) | random.below(axis) << k_axis_bits | random.below(head) << (2 * k_axis_bits);
    ASSERT_TRUE(is_packed_rotation(code));
    const Quaternion q = unpack_rotation(code);
    EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1, 1e-14);
  }
  for (const std::uint64_t bad : {axis, axis << k_axis_bits, head << (2 * k_axis_bits)})
    EXPECT_FALSE(is_packed_rotation(bad));
}

TEST(InstanceCodec, StepsArePowersOfTwoThatHoldTheExtent) {
  EXPECT_EQ(position_step(0), 0);
  EXPECT_EQ(position_step(-1), 0);
  EXPECT_EQ(position_step((1 << 21) - 1), 1);
  EXPECT_EQ(position_step(1 << 21), 2);
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const double extent = std::ldexp(random.uniform(), static_cast<int>(random.below(60)) - 30);
    const double step = position_step(extent);
    EXPECT_GE(step * 2097151, extent);
    EXPECT_LT(step * 2097151, 2 * extent * 1.000001);
    int exponent = 0;
    EXPECT_EQ(std::frexp(step, &exponent), 0.5);
  }
  EXPECT_GT(position_step(1e-300), 0);  // float32's smallest
}

TEST(InstanceCodec, PositionsComeBackWithinHalfAStepAndThenExactly) {
  Random random(3);
  InstanceBlock block;
  block.origin = {1e6, -20, 3};
  block.step = {0x1p-16f, 0x1p-18f, 0};
  for (int i = 0; i < 1000; ++i) {
    const Double3 p = block.origin + Double3{random.uniform(0, 30), random.uniform(0, 7), 0};
    const Double3 back = unpack_position(pack_position(p, block), block);
    EXPECT_LE(std::abs(back.x - p.x), 0x1p-17 + 1e-9);
    EXPECT_LE(std::abs(back.y - p.y), 0x1p-19 + 1e-12);
    EXPECT_EQ(back.z, 3);
    EXPECT_EQ(unpack_position(pack_position(back, block), block), back);
  }
}

TEST(InstanceCodec, TheEndsOfAScaleAreExact) {
  TreeType t;
  t.scale_min = 0.75f, t.scale_max = 1.25f;
  EXPECT_EQ(unpack_scale(pack_scale(0.75, t), t), 0.75);
  EXPECT_EQ(unpack_scale(pack_scale(1.25, t), t), 1.25);
  EXPECT_NEAR(unpack_scale(pack_scale(1, t), t), 1, 0.5 / 65535 / 2);
  t.scale_max = 0.75f;
  EXPECT_EQ(unpack_scale(pack_scale(0.75, t), t), 0.75);
}

TEST(InstanceCodec, ATransformedBoxIsThatOfItsEightCorners) {
  Random random(4);
  for (int i = 0; i < 2000; ++i) {
    const FloatBox box{{-1, -0.5f, -3}, {2, 7, 0.25f}};
    const Instance instance{.position = {random.uniform(-9, 9), 5, 1e3},
                            .rotation = random_rotation(random),
                            .scale = random.uniform(0.1, 4)};
    DoubleBox corners;
    for (int c = 0; c < 8; ++c) {
      const Double3 p{double{c & 1 ? box.max.x : box.min.x}, double{c & 2 ? box.max.y : box.min.y},
                      double{c & 4 ? box.max.z : box.min.z}};
      corners.grow(instance.position + rotate(instance.rotation, p * instance.scale));
    }
    const DoubleBox fast = transformed(box, instance);
    EXPECT_LT(distance(fast.min, corners.min), 1e-11);
    EXPECT_LT(distance(fast.max, corners.max), 1e-11);
  }
  EXPECT_TRUE(transformed(FloatBox{}, Instance{}).empty());
}

}  // namespace
}  // namespace copse
