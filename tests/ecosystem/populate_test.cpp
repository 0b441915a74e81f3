#include "lib/analysis/ecosystem/populate.h"

#include "lib/analysis/ecosystem/terrain_grid.h"
#include "lib/analysis/ecosystem/tilt.h"
#include "lib/formats/ecosystem/instance_codec.h"
#include "tests/ecosystem/grounds.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace copse {
namespace {

const PlantedArea k_area{0, 0, 64, 64};

struct World {
  Terrain terrain = regular_terrain(33, 64, [](double x, double z) { return 3 * std::sin(x / 9) + 0.1 * z; });
  TerrainGround ground{terrain};
  Result<Population> plant(const std::vector<TypePlan>& types, std::uint64_t seed = 1,
                           const PlantedArea& area = k_area) const {
    return populate(types, ground, area, Random(seed));
  }
};

std::vector<Instance> planted(const std::vector<TypePlan>& types, std::uint64_t seed = 1) {
  const auto population = World().plant(types, seed);
  EXPECT_TRUE(population);
  return population ? population->instances : std::vector<Instance>();
}

TypePlan type(std::uint64_t count) {
  TypePlan t;
  t.name = "types[0]";
  t.count = count;
  t.tilt_to_ground = true;
  t.scale = {0.5, 2};
  return t;
}

TEST(Populate, EveryFootIsOnTheGroundAndEveryTrunkAlongItsNormal) {
  const World world;
  const auto p = world.plant({type(3000), type(17)});
  ASSERT_TRUE(p);
  ASSERT_EQ(p->instances.size(), 3017u);
  for (const Instance& i : p->instances) {
    const auto here = world.ground.at(i.position.x, i.position.z);
    EXPECT_EQ(i.position.y, here->height);
    EXPECT_LT(distance(rotate(i.rotation, {0, 1, 0}), here->normal), 1e-14);
    EXPECT_TRUE(i.scale >= 0.5 && i.scale <= 2);
  }
}

TEST(Populate, CountsAreKeptWhateverTheyAre) {
  const World world;
  for (const std::uint64_t count : {0, 1, 2, 3, 1000, 100000}) {
    for (const PlantedArea& area : {k_area, PlantedArea{10, 10, 11, 11}, PlantedArea{5, 5, 5.001, 60}}) {
      const auto p = world.plant({type(count), type(count / 3)}, 1, area);
      ASSERT_TRUE(p);
      EXPECT_EQ(p->instances.size(), count + count / 3);
      for (const Instance& i : p->instances)
        EXPECT_TRUE(i.position.x >= area.x0 && i.position.x <= area.x1 && i.position.z >= area.z0 &&
                    i.position.z <= area.z1);
    }
  }
  EXPECT_TRUE(world.plant({})->instances.empty());
}

TEST(Populate, NeighboursNeverTouchWhereTheirCellsHoldThem) {
  TypePlan a = type(900), b = type(124);
  a.footprint = 0.49, b.footprint = 0.2;
  const auto p = World().plant({a, b});
  ASSERT_TRUE(p);
  EXPECT_EQ(p->types[0].crowded, 0u);  // cells of 2 m, at most 0.98 m to each side
  for (std::size_t i = 0; i < p->instances.size(); ++i)
    for (std::size_t k = i + 1; k < p->instances.size(); ++k) {
      const Instance &x = p->instances[i], &y = p->instances[k];
      const double reach = x.scale * (x.type ? 0.2 : 0.49) + y.scale * (y.type ? 0.2 : 0.49);
      EXPECT_GE(std::hypot(x.position.x - y.position.x, x.position.z - y.position.z), reach - 1e-9);
    }
}

// The scale is that of the very place, wherever in its cell the map puts it.
TEST(Populate, NeighboursNeverTouchUnderAnyScaleMap) {
  const World world;
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    Random random(seed);
    const auto side = static_cast<std::uint32_t>(1 + random.below(90));
    ValueMap map{side, 1 + side / 3, {}};
    for (std::uint32_t i = 0; i < map.width * map.height; ++i)
      map.values.push_back(static_cast<float>(random.uniform(-0.2, 1.2)));
    TypePlan a = type(300 + random.below(300)), b = type(200);
    a.scale_map = &map;
    a.scale = {random.uniform(0.05, 0.5), random.uniform(0.5, 4)};
    a.footprint = random.uniform(0.1, 1.5), b.footprint = 0.3;
    a.tilt_to_ground = random.chance(0.5);
    const auto p = world.plant({a, b}, seed);
    ASSERT_TRUE(p);
    ASSERT_EQ(p->instances.size(), a.count + 200);
    const double cell = 64 / std::sqrt(static_cast<double>(p->cells));
    const auto reach = [&](const Instance& i) { return i.scale * (i.type ? b.footprint : a.footprint); };
    std::uint64_t out = 0;
    for (const Instance& i : p->instances) {
      const double x = std::fmod(i.position.x, cell), z = std::fmod(i.position.z, cell), r = reach(i) - 1e-9;
      const bool inside = x - r >= 0 && x + r <= cell && z - r >= 0 && z + r <= cell;
      out += !inside;
    }
    EXPECT_LE(out, p->types[0].crowded + p->types[1].crowded) << seed;
  }
}

TEST(Populate, SpacedDiscsNeverOverlapUnderAnyScaleMap) {
  const World world;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    Random random(seed);
    const auto side = static_cast<std::uint32_t>(1 + random.below(90));
    ValueMap map{side, side, {}};
    for (std::uint32_t i = 0; i < side * side; ++i)
      map.values.push_back(static_cast<float>(random.uniform(-0.2, 1.2)));
    TypePlan a = type(1500), b = type(300);
    a.scale_map = &map;
    a.scale = {random.uniform(0.1, 0.9), random.uniform(1, 3)};
    a.spacing = random.uniform(0.2, 1), b.spacing = 0.7;
    a.fewer = b.fewer = true;
    const auto p = world.plant({a, b}, seed);
    ASSERT_TRUE(p);
    const auto radius = [&](const Instance& i) { return i.scale * (i.type ? b.spacing : a.spacing); };
    for (std::size_t i = 0; i < p->instances.size(); ++i)
      for (std::size_t k = i + 1; k < p->instances.size(); ++k) {
        const Instance &x = p->instances[i], &y = p->instances[k];
        const double apart = std::hypot(x.position.x - y.position.x, x.position.z - y.position.z);
        if (apart < radius(x) + radius(y) - 1e-9) ADD_FAILURE() << seed << ": " << i << ' ' << k;
      }
  }
}

// Of a map of four greys, up to what random packings hold.
TEST(Populate, SpacingKeepsADensitysHistogramUntilTheGroundIsFullAndThenSaysSo) {
  const World world;
  const ValueMap density{4, 1, {0, 1, 2, 3}};
  TypePlan a = type(0);
  a.scale = {0.7, 1.3};
  a.spacing = 0.5;
  a.rules.density = &density;
  a.count = 800;  // discs fill 0.16 of the ground, 0.31 where it is densest
  const auto room = world.plant({a});
  ASSERT_TRUE(room) << room.error().what;
  std::vector<double> quarters(4);
  for (const Instance& i : room->instances) ++quarters[static_cast<std::size_t>(i.position.x / 16)];
  for (std::size_t q = 0; q < 4; ++q) EXPECT_NEAR(quarters[q], 800.0 * static_cast<double>(q) / 6, 4);
  ASSERT_EQ(room->types[0].by_density.size(), 3u);
  EXPECT_LE(histogram_error(room->types[0].by_density), 0.02);

  a.count = 1800;  // 0.7 where it is densest: more than there is room for at random
  const auto full = world.plant({a});
  ASSERT_TRUE(full) << full.error().what;
  ASSERT_EQ(full->instances.size(), 1800u);
  const DensityShare& densest = full->types[0].by_density.back();
  EXPECT_NEAR(densest.asked, 900, 1e-6);
  EXPECT_LT(densest.got, 830u);
  EXPECT_GT(densest.covered, 0.52);
}

TEST(Populate, AMillionInAMetreEndSoonWithSpacing) {
  TypePlan a = type(1000000);
  a.spacing = 0.5;
  a.fewer = true;
  std::vector<double> heard;
  const World world;
  const auto p = populate(std::vector{a}, world.ground, {10, 10, 11, 11}, Random(1),
                          [&](double share) { heard.push_back(share); });
  ASSERT_TRUE(p);
  EXPECT_GE(p->instances.size(), 1u);
  EXPECT_EQ(p->instances.size() + p->types[0].missing, 1000000u);
  EXPECT_TRUE(std::is_sorted(heard.begin(), heard.end()));
}

TEST(Populate, WhatReachesOutOfItsCellIsCounted) {
  TypePlan a = type(1024);
  a.footprint = 3;
  EXPECT_EQ(World().plant({a})->types[0].crowded, 1024u);
}

TEST(Populate, SpacedDiscsNeverOverlapAcrossTypes) {
  TypePlan big = type(60), small = type(900);
  big.spacing = 1.5, small.spacing = 0.4;
  small.manual.push_back({.position = {32, 0, 32}, .scale = 2});
  const auto p = World().plant({small, big});
  ASSERT_TRUE(p) << p.error().what;
  ASSERT_EQ(p->instances.size(), 961u);
  const auto radius = [](const Instance& i) { return i.scale * (i.type == 1 ? 1.5 : 0.4); };
  for (std::size_t i = 0; i < p->instances.size(); ++i)
    for (std::size_t k = i + 1; k < p->instances.size(); ++k) {
      const Instance &x = p->instances[i], &y = p->instances[k];
      EXPECT_GE(std::hypot(x.position.x - y.position.x, x.position.z - y.position.z),
                radius(x) + radius(y) - 1e-12);
    }
}

TEST(Populate, WhatFindsNoRoomIsRefusedOrLess) {
  TypePlan a = type(2000);
  a.scale = {1, 1};
  a.spacing = 2;
  const auto refused = World().plant({a});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find("types[0]: 2000 asked for, there is room for "), std::string::npos);
  a.fewer = true;
  const auto less = World().plant({a});
  ASSERT_TRUE(less);
  EXPECT_GT(less->instances.size(),
            170u);  // 4096 m2 / 4 pi m2 is 326; random packings hold about 0.55 of that
  EXPECT_EQ(less->instances.size() + less->types[0].missing, 2000u);
  // What the refusal said there is room for is what finds room.
  EXPECT_NE(refused.error().what.find(std::to_string(less->instances.size())), std::string::npos);
}

TEST(Populate, MapsAndRulesAreKept) {
  const World world;
  ValueMap density{8, 8, std::vector<float>(64)}, forbidden{64, 64, std::vector<float>(4096)};
  for (std::size_t i = 0; i < 64; ++i) density.values[i] = static_cast<float>(i % 8);
  for (std::size_t i = 0; i < 4096; ++i) forbidden.values[i] = i / 64 % 16 < 4 ? 1 : 0;
  TypePlan a = type(20000);
  a.rules.density = &density;
  a.rules.forbidden = &forbidden;
  const auto p = world.plant({a});
  ASSERT_TRUE(p);
  std::vector<double> columns(8);
  for (const Instance& i : p->instances) {
    EXPECT_LT(pixel_at(forbidden, k_area, i.position.x, i.position.z), 0.5);
    ++columns[static_cast<std::size_t>(i.position.x / 8)];
  }
  for (std::size_t c = 0; c < 8; ++c)
    EXPECT_NEAR(columns[c], 20000.0 * static_cast<double>(c) / 28,
                0.02 * 20000 * static_cast<double>(c) / 28 + 1);
}

TEST(Populate, RulesThatAllowNothingAreRefusedByName) {
  TypePlan a = type(5);
  a.rules.altitude = {1000, 2000};
  const auto p = World().plant({a});
  ASSERT_FALSE(p);
  EXPECT_NE(p.error().what.find("types[0]: there is no place"), std::string::npos);
  a.count = 0;
  EXPECT_TRUE(World().plant({a}));
}

TEST(Populate, ScaleAndTintFollowTheirMaps) {
  const ValueMap scale{2, 1, {0, 1}};
  const TintMap tint{1, 2, {{10, 20, 30}, {40, 50, 60}}};
  TypePlan a = type(500);
  a.scale_map = &scale;
  a.tint_map = &tint;
  for (const Instance& i : planted({a})) {
    EXPECT_DOUBLE_EQ(i.scale, 0.5 + 1.5 * smooth_at(scale, k_area, i.position.x, i.position.z));
    EXPECT_EQ(i.tint[0], i.position.z < 32 ? 10 : 40);
  }
}

TEST(Populate, AnglesStayInTheirRanges) {
  TypePlan a = type(2000);
  a.tilt_to_ground = false;
  a.head = {20, 40}, a.pitch = {-3, 3}, a.roll = {1, 1};
  double leaning = 0;
  for (const Instance& i : planted({a})) {
    const Angles angles = angles_of(i.rotation);
    EXPECT_TRUE(angles.head > 19.999 && angles.head < 40.001);
    EXPECT_LE(std::abs(angles.pitch), 3.001);
    EXPECT_NEAR(angles.roll, 1, 1e-9);
    leaning += angles.pitch;
  }
  EXPECT_NEAR(leaning / 2000, 0, 0.2);  // both ways alike (erratum E6)
}

TEST(Populate, TheSameForAnyNumberOfThreadsAndAnotherForAnotherSeed) {
  TypePlan free = type(5000), ruled = type(3000), spaced = type(300);
  ruled.rules.altitude = {0, 100};
  spaced.spacing = 0.5;
  const auto positions = [&](std::uint64_t seed) {
    std::vector<Double3> out;
    for (const Instance& i : planted({free, ruled, spaced}, seed)) out.push_back(i.position);
    return out;
  };
  const auto many = positions(1);
  EXPECT_NE(many, positions(2));
  const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(many, positions(1));
}

// The same numbers everywhere: a change of any algorithm, or a machine that computes otherwise, shows here.
TEST(Populate, IsTheSameOnEveryMachine) {
  TerrainPlan plan{.width = 64, .depth = 64, .columns = 65, .rows = 65};
  plan.faults = {.count = 30, .first = 1, .last = 0.1, .smooth = 1};
  const auto terrain = make_terrain(plan, Random(3));
  ASSERT_TRUE(terrain);
  TypePlan spaced = type(100), steep = type(200);
  spaced.spacing = 0.5;
  spaced.rules.clusters = {.count = 3, .radius = 20};
  steep.rules.slope = {5, 90};
  const auto p =
      populate(std::vector{type(1000), spaced, steep}, TerrainGround(*terrain), k_area, Random(42));
  ASSERT_TRUE(p);
  std::uint64_t hash = 0;
  InstanceBlock block;
  block.origin = {0, -16, 0};
  block.step = {0x1p-14f, 0x1p-14f, 0x1p-14f};
  for (const Instance& i : p->instances)
    hash = Random::mix(hash ^ pack_position(i.position, block)) + pack_rotation(i.rotation);
  EXPECT_EQ(hash, 12234802074127933169u);
}

}  // namespace
}  // namespace copse
