#include "lib/formats/volumes/sphere_contains.h"

#include "lib/formats/random.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(SphereContains, APointOnTheSurfaceIsInside) {
  EXPECT_TRUE(sphere_contains({0, 0, 0}, 5, {3, 4, 0}));
  EXPECT_FALSE(sphere_contains({0, 0, 0}, std::nextafter(5.0f, 0.0f), {3, 4, 0}));
  EXPECT_TRUE(sphere_contains({1, 1, 1}, 0, {1, 1, 1}));
  EXPECT_FALSE(sphere_contains({1, 1, 1}, 0, {1, 1, std::nextafter(1.0f, 2.0f)}));
}

TEST(SphereContains, SeesADifferenceThatDoublesLose) {
  // 1e10 - 1e-10 needs 66 bits: rounded to double, the point would lie on the surface.
  const float tiny = 1e-10f, huge = 1e10f;
  EXPECT_TRUE(sphere_contains({0, 0, 0}, huge, {huge, 0, 0}));
  EXPECT_FALSE(sphere_contains({-tiny, 0, 0}, huge, {huge, 0, 0}));
  EXPECT_TRUE(sphere_contains({tiny, 0, 0}, huge, {huge, 0, 0}));
  EXPECT_FALSE(sphere_contains({0, tiny, 0}, huge, {huge, 0, 0}));
  EXPECT_FALSE(sphere_contains({0, 0, 0}, huge, {0, 0, 0}, std::nextafter(huge, 2 * huge)));
  EXPECT_FALSE(sphere_contains({0, 0, 0}, huge, {tiny, 0, 0}, huge));
}

TEST(SphereContains, HoldsAtTheEndsOfTheRange) {
  const float max = std::numeric_limits<float>::max(), least = std::numeric_limits<float>::denorm_min();
  EXPECT_TRUE(sphere_contains({0, 0, 0}, max, {max, 0, 0}));
  EXPECT_FALSE(sphere_contains({0, 0, 0}, max, {max, least, 0}));
  EXPECT_FALSE(sphere_contains({-max, 0, 0}, max, {max, 0, 0}));
  EXPECT_TRUE(sphere_contains({0, 0, 0}, least, {0, -least, 0}));
  EXPECT_FALSE(sphere_contains({0, 0, 0}, least, {least, -least, 0}));
  EXPECT_FALSE(sphere_contains({max, 0, 0}, 0, {std::nextafter(max, 0.0f), 0, 0}));
}

// Small whole numbers, whose squares 64-bit integers hold: the truth is simple. Scaling by powers of two and
// shifting by whole numbers change nothing.
TEST(SphereContains, AgreesWithWholeNumbers) {
  Random random(1);
  int inside = 0;
  for (int i = 0; i < 200000; ++i) {
    const auto coordinate = [&] { return static_cast<std::int64_t>(random.below(41)) - 20; };
    const std::int64_t x = coordinate(), y = coordinate(), z = coordinate();
    const auto near = static_cast<std::int64_t>(std::sqrt(static_cast<double>(x * x + y * y + z * z)));
    const std::int64_t r = std::max<std::int64_t>(0, near + static_cast<std::int64_t>(random.below(4)) - 1);
    const auto inner = static_cast<std::int64_t>(random.below(3));
    const bool truth = r >= inner && x * x + y * y + z * z <= (r - inner) * (r - inner);
    const float s = std::ldexp(1.0f, static_cast<int>(random.below(120)) - 80);
    const auto f = [&](std::int64_t v) { return s * static_cast<float>(v); };
    const std::int64_t shift = static_cast<std::int64_t>(random.below(1 << 20));
    ASSERT_EQ(sphere_contains({f(shift), 0, f(-shift)}, f(r), {f(shift + x), f(y), f(z - shift)}, f(inner)),
              truth)
        << x << " " << y << " " << z << " r " << r << " " << inner;
    inside += truth;
  }
  EXPECT_GT(inside, 20000);
}

// Radii one float32 below and above the distance in extended precision, where that tells them apart.
TEST(SphereContains, AgreesWithExtendedPrecisionNearTheSurface) {
  Random random(2);
  for (int i = 0; i < 100000; ++i) {
    const auto f = [&] { return static_cast<float>(random.uniform(-1, 1)); };
    const Float3 c{f(), f(), f()}, p{f(), f(), f()};
    const auto square = [](long double v) { return v * v; };
    const long double d2 =
        square((long double)p.x - c.x) + square((long double)p.y - c.y) + square((long double)p.z - c.z);
    float r = static_cast<float>(std::sqrt(d2));
    for (int step = -1; step <= 1; ++step) {
      const float radius = step < 0 ? std::nextafter(r, 0.0f) : step > 0 ? std::nextafter(r, 2.0f) : r;
      const long double gap = square(radius) - d2;
      if (std::abs(gap) < 1e-17L) continue;
      ASSERT_EQ(sphere_contains(c, radius, p), gap > 0);
    }
  }
}

}  // namespace
}  // namespace copse
