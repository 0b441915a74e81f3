// Every position of arrays of every length around a block: no tail may be overlooked.
#include "lib/formats/tree/scan.h"

#include <limits>

#include <gtest/gtest.h>

namespace copse {
namespace {

constexpr float k_inf = std::numeric_limits<float>::infinity();
constexpr float k_nan = std::numeric_limits<float>::quiet_NaN();
constexpr std::size_t k_longest = 140;

TEST(Scan, FiniteSeesInfinityAndNanAtEveryPlace) {
  for (std::size_t n = 0; n <= k_longest; ++n) {
    std::vector<float> floats(n, -std::numeric_limits<float>::max());
    std::vector<double> doubles(n, std::numeric_limits<double>::max());
    ASSERT_TRUE(all_finite(std::span<const float>(floats)));
    ASSERT_TRUE(all_finite(std::span<const double>(doubles)));
    for (std::size_t i = 0; i < n; ++i) {
      for (const float bad : {k_inf, -k_inf, k_nan}) {
        floats[i] = bad, doubles[i] = double{bad};
        ASSERT_FALSE(all_finite(std::span<const float>(floats))) << n << " " << i;
        ASSERT_FALSE(all_finite(std::span<const double>(doubles))) << n << " " << i;
      }
      floats[i] = std::numeric_limits<float>::denorm_min(), doubles[i] = -0.0;
    }
  }
}

TEST(Scan, BelowSeesEveryPlace) {
  for (std::size_t n = 0; n <= k_longest; ++n) {
    std::vector<std::uint32_t> v(n, 6);
    ASSERT_TRUE(all_below(v, 7));
    ASSERT_TRUE(all_below_or_none(v, 7));
    for (std::size_t i = 0; i < n; ++i) {
      v[i] = 7;
      ASSERT_FALSE(all_below(v, 7));
      ASSERT_FALSE(all_below_or_none(v, 7));
      v[i] = k_none;
      ASSERT_FALSE(all_below(v, 7));
      ASSERT_TRUE(all_below_or_none(v, 7));
      v[i] = 0;
    }
  }
  const std::vector<std::uint32_t> last{k_none - 1};
  EXPECT_FALSE(all_below_or_none(last, k_none - 1));
  EXPECT_FALSE(all_below_or_none(last, 0));
  EXPECT_TRUE(all_below_or_none(std::vector<std::uint32_t>{k_none}, 0));
}

TEST(Scan, CornersSeeEveryPlace) {
  for (std::size_t n = 0; n <= 13; ++n) {
    std::vector<CornerTriangle> t(
        n, CornerTriangle{.vertex = {4, 4, 4}, .normal = {2, k_none, 2}, .texcoord = {0, 0, k_none}});
    ASSERT_TRUE(corners_below(t, 5, 3, 1));
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        const CornerTriangle sound = t[i];
        for (const std::uint32_t bad : {5u, k_none}) {
          t[i].vertex[c] = bad;
          ASSERT_FALSE(corners_below(t, 5, 3, 1));
        }
        t[i] = sound, t[i].normal[c] = 3;
        ASSERT_FALSE(corners_below(t, 5, 3, 1));
        t[i] = sound, t[i].texcoord[c] = 1;
        ASSERT_FALSE(corners_below(t, 5, 3, 1));
        t[i] = sound;
      }
    }
  }
  EXPECT_FALSE(corners_below(std::vector<CornerTriangle>(1), 0, 0, 0));
  EXPECT_TRUE(corners_below(std::vector<CornerTriangle>(), 0, 0, 0));
  EXPECT_TRUE(corners_below(std::vector<CornerTriangle>(1), 1, 0, 0));
}

TEST(Scan, SortedSeesEveryPlace) {
  for (std::size_t n = 2; n <= k_longest; ++n) {
    for (std::size_t i = 1; i < n; ++i) {
      std::vector<float> v(n, 1.0f);
      ASSERT_TRUE(non_decreasing(std::span<const float>(v)));
      v[i] = 0.5f;
      ASSERT_FALSE(non_decreasing(std::span<const float>(v)));
    }
  }
  EXPECT_TRUE(non_decreasing(std::span<const double>()));
}

TEST(Scan, BoxHoldsEveryPoint) {
  EXPECT_TRUE(box_of({}).empty());
  for (std::size_t n = 1; n <= 20; ++n) {
    for (std::size_t i = 0; i < n; ++i) {
      std::vector<Float3> p(n, Float3{1, 2, 3});
      p[i] = {-7, 9, 3};
      FloatBox wanted;
      for (const Float3& q : p) wanted.grow(q);
      ASSERT_EQ(box_of(p), wanted) << n << " " << i;
    }
  }
}

}  // namespace
}  // namespace copse
