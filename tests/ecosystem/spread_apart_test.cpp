#include "lib/analysis/ecosystem/spread_apart.h"

#include "tests/ecosystem/grounds.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace copse {
namespace {

const PlantedArea k_area{0, 0, 64, 64};

struct World {
  Terrain terrain = regular_terrain(3, 64, [](double, double) { return 0; });
  TerrainGround ground{terrain};
};

// What became of a call.
struct Outcome {
  std::vector<Disc> discs;
  std::vector<std::uint64_t> numbers;
  std::uint64_t missing = 0, hindered = 0;
};

struct Wish {
  std::uint64_t count = 0;
  double least = 1, most = 1;
  std::function<double(const GroundPlace&)> by_place{};
  std::vector<GroundPlace> feet{};
  PlacementRules rules{};
  std::uint64_t seed = 1;
};

Outcome spread(const Wish& w, Spacing before = {}) {
  const World world;
  const DensityField field =
      make_field(PlacementTest(w.rules, k_area, world.ground), 128, 128, Random(w.seed));
  const PlacementTest test(w.rules, k_area, world.ground);
  Outcome out;
  DiscsApart wanted;
  wanted.count = w.count;
  wanted.radius = [&](std::uint64_t i, const GroundPlace& at) {
    return w.by_place ? w.by_place(at) : Random(99).fork(i).uniform(w.least, w.most);
  };
  wanted.by_place = static_cast<bool>(w.by_place);
  wanted.least = [&](const Patch&) { return w.least; };
  wanted.least_anywhere = w.least;
  wanted.feet = w.feet;
  wanted.place = [&](std::uint64_t i, const GroundPlace& at) {
    out.discs.push_back({at.x, at.z, wanted.radius(i, at)});
    out.numbers.push_back(i);
  };
  const ApartCounts counts = spread_apart(wanted, field, Spreader(field), test, Random(w.seed), before);
  out.missing = counts.missing;
  out.hindered = counts.hindered;
  EXPECT_EQ(out.missing + out.discs.size(), w.count);
  std::sort(out.numbers.begin(), out.numbers.end());
  EXPECT_EQ(std::adjacent_find(out.numbers.begin(), out.numbers.end()), out.numbers.end());
  for (std::size_t i = 0; i < out.discs.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const Disc &a = out.discs[i], &b = out.discs[k];
      if (std::hypot(a.x - b.x, a.z - b.z) < a.radius + b.radius - 1e-12) ADD_FAILURE() << i << ' ' << k;
    }
  return out;
}

double covered(const std::vector<Disc>& discs) {
  double sum = 0;
  for (const Disc& d : discs) sum += std::numbers::pi * d.radius * d.radius;
  return sum / (64 * 64);
}

// The widest gap for a disc of this radius, by a fine grid of centres.
int free_places(const Outcome& o, double radius) {
  int free = 0;
  for (int r = 0; r < 256; ++r)
    for (int c = 0; c < 256; ++c) {
      bool clear = true;
      for (const Disc& d : o.discs)
        clear = clear && std::hypot(d.x - (c + 0.5) / 4, d.z - (r + 0.5) / 4) >= d.radius + radius;
      free += clear;
    }
  return free;
}

TEST(SpreadApart, StopsOnlyWhenNoGapIsLeft) {
  for (const double most : {1.0, 2.0}) {
    const Outcome o = spread({.count = 3000, .least = 1, .most = most});
    EXPECT_GT(o.missing, 0u);
    // Random packings of equal discs jam at 0.547 of the plane; half of a disc on the border is outside.
    EXPECT_GT(covered(o.discs), 0.53);
    // What waits at the end may all be larger than the smallest: those have no gap.
    EXPECT_EQ(free_places(o, most), 0);
  }
}

// However little wider it is than the disc.
TEST(SpreadApart, FindsTheOnlyGap) {
  Spacing full;
  for (int r = 0; r < 32; ++r)
    for (int c = 0; c < 32; ++c)
      if (r != 20 || c != 11) full.add({2.0 * c + 1, 2.0 * r + 1, 1});
  for (const double narrow : {0.1, 1e-3, 1e-6}) {
    const Outcome o = spread({.count = 1, .least = 1 - narrow, .most = 1 - narrow}, full);
    ASSERT_EQ(o.discs.size(), 1u) << narrow;
    EXPECT_NEAR(o.discs[0].x, 23, 2 * narrow);
    EXPECT_NEAR(o.discs[0].z, 41, 2 * narrow);
  }
}

// Three quarters of the trees for the half that is dense, at every fullness that leaves it room at random.
TEST(SpreadApart, KeepsADensitysHistogramWithinTwoPercentUntilTheGroundIsFull) {
  const ValueMap density{2, 1, {1, 3}};
  for (const double fullness : {0.1, 0.2, 0.25, 0.3}) {
    const auto count = static_cast<std::uint64_t>(fullness * 64 * 64 / (std::numbers::pi * 0.25));
    const Outcome o = spread({.count = count, .least = 0.5, .most = 0.5, .rules = {.density = &density}});
    EXPECT_EQ(o.missing, 0u);
    double east = 0;
    for (const Disc& d : o.discs) east += d.x >= 32;
    EXPECT_NEAR(east / static_cast<double>(count), 0.75, 0.01) << fullness;
    EXPECT_GT(o.hindered, 0u);
    EXPECT_LT(o.hindered, count) << fullness;
  }
}

TEST(SpreadApart, OnFullGroundTheRestGoesWhereThereIsRoom) {
  const ValueMap density{2, 1, {1, 99}};
  const auto count = static_cast<std::uint64_t>(0.45 * 64 * 64 / std::numbers::pi);
  const Outcome o = spread({.count = count, .rules = {.density = &density}});
  EXPECT_EQ(o.missing, 0u);
  const auto west = std::count_if(o.discs.begin(), o.discs.end(), [](const Disc& d) { return d.x < 32; });
  EXPECT_GT(static_cast<std::uint64_t>(west), count / 4);
  EXPECT_GT(o.hindered, count / 4);
}

TEST(SpreadApart, RadiiMayGoByThePlace) {
  const Outcome o = spread(
      {.count = 100000, .least = 0.5, .by_place = [](const GroundPlace& at) { return 0.5 + at.x / 32; }});
  EXPECT_GT(o.missing, 0u);
  EXPECT_GT(covered(o.discs), 0.5);
}

TEST(SpreadApart, KeepsOffFeetInGapsToo) {
  Random random(5);
  std::vector<GroundPlace> feet;
  for (int i = 0; i < 40; ++i) feet.push_back({random.uniform(0, 64), random.uniform(0, 64)});
  const Outcome o = spread({.count = 3000, .least = 0.8, .most = 2, .feet = feet});
  EXPECT_GT(o.missing, 0u);
  for (const Disc& d : o.discs)
    for (const GroundPlace& f : feet) EXPECT_GE(std::hypot(d.x - f.x, d.z - f.z), d.radius - 1e-12);
}

TEST(SpreadApart, WorkIsBoundedWhereNothingFitsAndWhereLittleIsAllowed) {
  Spacing giant;
  giant.add({32, 32, 1e6});
  EXPECT_EQ(spread({.count = 1000000}, giant).missing, 1000000u);
  // One pixel of 64 x 64 is allowed, for discs far smaller than it.
  ValueMap forbidden{64, 64, std::vector<float>(64 * 64, 1)};
  forbidden.values[1234] = 0;
  const Outcome o = spread({.count = 5000, .least = 0.02, .most = 0.02, .rules = {.forbidden = &forbidden}});
  EXPECT_GT(o.discs.size(), 350u);  // of 0.547 / (pi 0.02^2) = 435 and those on the border
  for (const Disc& d : o.discs) EXPECT_LT(pixel_at(forbidden, k_area, d.x, d.z), 0.5);
}

// There are more of them round a patch than are looked at together.
TEST(SpreadApart, FindsTheGapsAmongManyThatAreMuchSmaller) {
  Spacing seedlings;
  Random random(8);
  for (int i = 0; i < 10000; ++i) {
    const double x = random.uniform(0, 64), z = random.uniform(0, 64);
    if (std::hypot(x - 40, z - 20) > 3.01) seedlings.add({x, z, 0.005});
  }
  EXPECT_EQ(spread({.count = 50, .least = 3, .most = 3}, seedlings).discs.size(), 1u);
  EXPECT_GT(spread({.count = 4000, .least = 0.5, .most = 0.5}, seedlings).missing, 0u);
}

TEST(SpreadApart, ProgressGoesFromNothingToAllAndNeverBack) {
  const World world;
  const PlacementRules rules;
  const DensityField field = make_field(PlacementTest(rules, k_area, world.ground), 64, 64, Random(1));
  const PlacementTest test(rules, k_area, world.ground);
  double last = 0;
  DiscsApart wanted;
  wanted.count = 20000;
  wanted.radius = [](std::uint64_t, const GroundPlace&) { return 1.0; };
  wanted.least = [](const Patch&) { return 1.0; };
  wanted.least_anywhere = 1;
  wanted.place = [](std::uint64_t, const GroundPlace&) {};
  wanted.progress = [&](double share) {
    EXPECT_GE(share, last);
    EXPECT_LE(share, 1);
    last = share;
  };
  Spacing discs;
  spread_apart(wanted, field, Spreader(field), test, Random(1), discs);
  EXPECT_GT(last, 0.9);
}

}  // namespace
}  // namespace copse
