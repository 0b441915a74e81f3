#include "lib/analysis/ecosystem/mix_masses.h"

#include "tests/ecosystem/grounds.h"

#include <deque>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace copse {
namespace {

const PlantedArea k_area{0, 0, 64, 64};
constexpr std::uint32_t k_side = 96;

// Any number of types that share one density, with rules of every kind among them.
struct Mix {
  explicit Mix(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      ValueMap& share = maps.emplace_back(ValueMap{32, 32, std::vector<float>(32 * 32)});
      Random random(i);
      for (float& v : share.values) v = static_cast<float>(random.uniform(-0.2, 1));
      shares.push_back(&share);
    }
    totals = means_by_size(shares);
    for (std::size_t i = 0; i < count; ++i) {
      PlacementRules& r = rules.emplace_back();
      r.density = &density;
      r.share_of = shares[i];
      for (const ValueMap& t : totals) r.share_total.push_back(&t);
      parts.push_back({&r, Random(100 + i)});
    }
  }

  MixMasses masses() const { return mix_masses(parts, k_area, ground, k_side, k_side); }
  double mass_alone(std::size_t i) const {
    return make_field(PlacementTest(rules[i], k_area, ground), k_side, k_side, parts[i].random).total();
  }

  Terrain terrain = regular_terrain(65, 64, [](double x, double z) { return x < 32 ? z / 8 : x - 32; });
  TerrainGround ground{terrain};
  ValueMap density{2, 2, {0, 1, 2, 0.5f}}, mark{16, 16, std::vector<float>(256)};
  std::deque<ValueMap> maps;
  std::vector<const ValueMap*> shares;
  std::vector<ValueMap> totals;
  std::deque<PlacementRules> rules;
  std::vector<MixPart> parts;
};

TEST(MixMasses, AreThoseOfTheFieldsThatArePlanted) {
  Mix mix(6);
  mix.mark.values[100] = 1;
  mix.rules[1].slope = {0, 30};
  mix.rules[2].clusters = {.count = 3, .radius = 9};
  mix.rules[3].forbidden = mix.shares[0];
  mix.rules[4].distance_to = &mix.mark;
  mix.rules[4].distance = {2, 20};
  mix.rules[5].altitude = {3, 12};
  mix.rules[5].distance_to = &mix.mark;
  mix.rules[5].distance.min = 5;
  const MixMasses m = mix.masses();
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(m.masses[i], mix.mass_alone(i)) << i;
    EXPECT_GT(m.masses[i], 0) << i;
  }
}

TEST(MixMasses, ThePointsAreLookedAtOnceForAllTypes) {
  const std::uint64_t one = Mix(1).masses().points;
  EXPECT_EQ(one, std::uint64_t{k_side} * k_side);
  EXPECT_EQ(Mix(16).masses().points, one);
}

TEST(MixMasses, WhereNoClusterReachesNothingIsAsked) {
  Mix mix(2);
  for (PlacementRules& r : mix.rules) r.clusters = {.count = 1, .radius = 6};
  const MixMasses m = mix.masses();
  EXPECT_LT(m.points, std::uint64_t{k_side} * k_side / 10);
  EXPECT_EQ(m.masses[1], mix.mass_alone(1));
}

TEST(MixMasses, TheSameForAnyNumberOfThreads) {
  const Mix mix(5);
  const auto many = mix.masses().masses;
  const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(many, mix.masses().masses);
}

TEST(MixMasses, OfNothingAreNothing) {
  const Mix mix(1);
  EXPECT_TRUE(mix_masses({}, k_area, mix.ground, 4, 4).masses.empty());
  Mix empty(2);
  empty.density.values = {0, 0, 0, 0};
  EXPECT_EQ(empty.masses().masses, (std::vector<double>{0, 0}));
}

}  // namespace
}  // namespace copse
