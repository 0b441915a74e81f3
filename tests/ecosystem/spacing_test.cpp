#include "lib/analysis/ecosystem/spacing.h"

#include "lib/formats/random.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

bool overlaps(const Disc& a, const Disc& b) {
  const double dx = a.x - b.x, dz = a.z - b.z, r = a.radius + b.radius;
  return dx * dx + dz * dz < r * r;
}

TEST(Spacing, AgreesWithTestingEveryDisc) {
  Random random(1);
  Spacing spacing;
  std::vector<Disc> inside;
  for (int i = 0; i < 4000; ++i) {
    // Radii over five decades, in any order.
    const Disc d{random.uniform(-50, 50), random.uniform(-50, 50),
                 0.001 * static_cast<double>(1 << random.below(12))};
    bool free = true;
    for (const Disc& other : inside) free &= !overlaps(d, other);
    EXPECT_EQ(spacing.is_free(d), free);
    if (!free) continue;
    spacing.add(d);
    inside.push_back(d);
  }
  EXPECT_EQ(spacing.size(), inside.size());
  EXPECT_GT(inside.size(), 500u);
}

TEST(Spacing, TouchingIsAllowedAndPointsNeedNoRoom) {
  Spacing spacing;
  spacing.add({0, 0, 1});
  EXPECT_TRUE(spacing.is_free({3, 0, 2}));
  EXPECT_FALSE(spacing.is_free({3, 0, 2.001}));
  spacing.add({9, 9, 0});
  EXPECT_TRUE(spacing.is_free({9, 9, 0}));
}

TEST(Spacing, AGiantAmongSeedlingsIsFoundFromFarAway) {
  Spacing spacing;
  spacing.add({0, 0, 100});
  for (int i = 0; i < 1000; ++i) {
    const double x = i * 0.2;
    EXPECT_EQ(spacing.is_free({x, 0, 0.05}), x >= 100.05);
  }
}

TEST(Spacing, ALargeDiscAmongTinyOnesIsAnsweredAtOnce) {
  Spacing spacing;
  for (const double radius : {5e-5, 1e-12, 1e-300}) spacing.add({1, 1, radius});
  EXPECT_FALSE(spacing.is_free({0, 0, 500}));
  EXPECT_TRUE(spacing.is_free({0, -500, 500}));
}

TEST(Spacing, ClearanceAndClosingAgreeWithTestingEveryDisc) {
  Random random(2);
  Spacing spacing;
  std::vector<Disc> inside;
  for (int i = 0; i < 300; ++i) {
    const Disc d{random.uniform(-20, 20), random.uniform(-20, 20),
                 0.01 * static_cast<double>(1 << random.below(9))};
    spacing.add(d);
    inside.push_back(d);
  }
  int closed = 0;
  for (int i = 0; i < 3000; ++i) {
    const double x = random.uniform(-20, 20), z = random.uniform(-20, 20), most = random.uniform(0.1, 5);
    double clear = most;
    for (const Disc& d : inside) clear = std::min(clear, std::hypot(x - d.x, z - d.z) - d.radius);
    EXPECT_NEAR(spacing.clearance(x, z, most), clear, 1e-12);
    const Patch p{x, z, random.uniform(0, 2), random.uniform(0, 2)};
    const double radius = random.uniform(0.1, 2);
    bool one_is_in_the_way = false;
    std::size_t some = 0;
    for (const Disc& d : inside) {
      const double dx = d.x - std::clamp(d.x, p.x, p.x + p.width),
                   dz = d.z - std::clamp(d.z, p.z, p.z + p.depth);
      some += std::hypot(dx, dz) < d.radius + radius;
      double farthest = 0;
      for (const double cx : {p.x, p.x + p.width})
        for (const double cz : {p.z, p.z + p.depth})
          farthest = std::max(farthest, std::hypot(cx - d.x, cz - d.z));
      one_is_in_the_way |= farthest < d.radius + radius;
    }
    std::vector<Disc> near;
    EXPECT_EQ(spacing.closes(p, radius, 5, near), one_is_in_the_way);
    if (!one_is_in_the_way) {
      EXPECT_EQ(near.size(), std::min<std::size_t>(some, 6));
    }
    closed += one_is_in_the_way;
  }
  EXPECT_GT(closed, 300);
  EXPECT_LT(closed, 2700);
}

}  // namespace
}  // namespace copse
