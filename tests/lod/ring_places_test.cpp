#include "lib/analysis/lod/ring_places.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

namespace copse {
namespace {

struct Path {
  std::vector<Double3> centres;
  std::vector<double> along, radii;
  void add(const Double3& c, double radius = 0.1) {
    along.push_back(centres.empty() ? 0 : along.back() + distance(centres.back(), c));
    centres.push_back(c), radii.push_back(radius);
  }
  LimbAxis axis() const { return {centres, along, radii}; }
  std::vector<Double3> shifts(const std::vector<std::uint32_t>& kept,
                              const std::vector<std::uint8_t>& fixed = {}) const {
    return ring_shifts(axis(), kept, fixed.empty() ? std::vector<std::uint8_t>(kept.size(), 0) : fixed);
  }
};

Path zigzag(int rings, double aside) {
  Path path;
  for (int i = 0; i < rings; ++i) path.add({i % 2 == 0 ? 0 : aside, 0.2 * i, 0});
  return path;
}

std::vector<std::uint32_t> every(std::uint32_t step, std::size_t rings) {
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < rings; i += step) kept.push_back(i);
  if (kept.back() + 1 != rings) kept.push_back(static_cast<std::uint32_t>(rings - 1));
  return kept;
}

// The sum of squares of how far all rings lie from the axis.
double off_axis(const Path& path, const std::vector<std::uint32_t>& kept,
                const std::vector<Double3>& shifts) {
  double sum = 0;
  for (std::size_t k = 0; k + 1 < kept.size(); ++k) {
    const Double3 a = path.centres[kept[k]] + shifts[k], b = path.centres[kept[k + 1]] + shifts[k + 1];
    for (std::uint32_t i = kept[k]; i < kept[k + 1]; ++i) {
      const Double3 d = path.centres[i] - a, along = normalized(b - a);
      sum += dot(d, d) - dot(d, along) * dot(d, along);
    }
  }
  return sum;
}

TEST(RingPlaces, WhatIsStraightStays) {
  Path path;
  for (int i = 0; i < 9; ++i) path.add({0.3 * i, 1.0 * i, 0});
  for (const Double3& s : path.shifts(every(2, 9))) EXPECT_EQ(length(s), 0);
}

TEST(RingPlaces, AnAxisThatCutsAllCornersGoesBetweenThem) {
  const Path path = zigzag(21, 0.05);
  const std::vector<std::uint32_t> kept = every(2, 21);
  const std::vector<Double3> shifts = path.shifts(kept);
  // In its middle every ring that is kept has one beside it: half of the way, nearly.
  EXPECT_NEAR(shifts[5].x, 0.025, 0.005);
  EXPECT_LT(off_axis(path, kept, shifts),
            0.6 * off_axis(path, kept, std::vector<Double3>(kept.size(), Double3{})));
}

TEST(RingPlaces, TheEndsAndWhatIsFixedStay) {
  const Path path = zigzag(21, 0.05);
  const std::vector<std::uint32_t> kept = every(2, 21);
  std::vector<std::uint8_t> fixed(kept.size(), 0);
  fixed[4] = 1;
  const std::vector<Double3> shifts = path.shifts(kept, fixed);
  EXPECT_EQ(length(shifts.front()), 0);
  EXPECT_EQ(length(shifts.back()), 0);
  EXPECT_EQ(length(shifts[4]), 0);
  EXPECT_GT(length(shifts[6]), 0);
}

TEST(RingPlaces, WhatIsFarFromAChangeStays) {
  Path path;
  for (int i = 0; i < 60; ++i) path.add({i == 5 ? 0.08 : 0, 0.2 * i, 0});
  const std::vector<Double3> shifts = path.shifts(every(2, 60));
  EXPECT_GT(length(shifts[2]) + length(shifts[3]), 0);
  for (std::size_t k = 10; k < shifts.size(); ++k) EXPECT_EQ(length(shifts[k]), 0) << k;
}

TEST(RingPlaces, NoRingIsFartherThanTheFarthestWas) {
  for (int seed = 1; seed <= 40; ++seed) {
    Path path;
    for (int i = 0; i < 31; ++i)
      path.add({0.2 * std::sin(1.7 * seed * i), 0.1 * i, 0.3 * std::cos(0.9 * seed + i * i)},
               0.02 + 0.01 * (i % 3));
    const std::vector<std::uint32_t> kept = every(3, 31);
    const std::vector<Double3> shifts = path.shifts(kept), none(kept.size());
    const auto farthest = [&](const std::vector<Double3>& s) {
      double most = 0;
      for (std::size_t k = 0; k + 1 < kept.size(); ++k)
        for (std::uint32_t i = kept[k]; i <= kept[k + 1]; ++i) {
          const double t =
              (path.along[i] - path.along[kept[k]]) / (path.along[kept[k + 1]] - path.along[kept[k]]);
          const Double3 a = path.centres[kept[k]], chord = path.centres[kept[k + 1]] - a;
          const Double3 off = path.centres[i] - a - chord * t, ahead = normalized(chord);
          most = std::max(most, length(off - ahead * dot(off, ahead) - s[k] * (1 - t) - s[k + 1] * t));
        }
      return most;
    };
    EXPECT_LE(farthest(shifts), farthest(none) * (1 + 1e-12)) << seed;
  }
}

TEST(RingPlaces, ListsThatDegenerateGiveNoNonsense) {
  Path point;  // all rings in one place, without thickness
  for (int i = 0; i < 7; ++i) point.add({1, 2, 3}, 0);
  for (const Double3& s : point.shifts({0, 2, 4, 6})) EXPECT_EQ(length(s), 0);
  const Path two = zigzag(2, 0.1);
  EXPECT_EQ(two.shifts({0, 1}).size(), 2u);
  const Path none_left_out = zigzag(9, 0.1);
  for (const Double3& s : none_left_out.shifts(every(1, 9))) EXPECT_EQ(length(s), 0);
}

}  // namespace
}  // namespace copse
