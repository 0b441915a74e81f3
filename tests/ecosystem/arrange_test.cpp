#include "lib/analysis/ecosystem/arrange.h"

#include "lib/analysis/ecosystem/tilt.h"
#include "lib/formats/ecosystem/ecosystem_file.h"
#include "lib/formats/ecosystem/instance_codec.h"
#include "lib/formats/random.h"
#include "tests/ecosystem/grounds.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

namespace copse {
namespace {

const Terrain k_terrain =
    regular_terrain(65, 256, [](double x, double z) { return 5 * std::sin(x / 30) + 0.05 * z; });

std::vector<Instance> random_instances(std::size_t count, double size, std::uint32_t types,
                                       std::uint64_t seed = 1) {
  const TerrainGround ground(k_terrain);
  std::vector<Instance> out(count);
  for (std::size_t i = 0; i < count; ++i) {
    Random r = Random(seed).fork(i);
    const double x = r.uniform(0, size), z = r.uniform(0, size);
    const auto here = ground.at(x, z);
    out[i] = {.position = {x, here->height, z},
              .rotation = with_head(tilt_to(here->normal), r.uniform(0, 360)),
              .scale = r.uniform(0.5, 1.5),
              .type = static_cast<std::uint32_t>(r.below(types)),
              .on_ground = true,
              .along_normal = true};
  }
  return out;
}

Ecosystem with_types(std::uint32_t types) {
  Ecosystem eco;
  for (std::uint32_t t = 0; t < types; ++t)
    eco.types.push_back({.name = "tree", .uri = "tree.stree", .bounds = {{-2, 0, -1}, {1, 6, 2}}});
  return eco;
}

ArrangeOptions options(double size, bool exact = false) {
  static const TerrainGround ground(k_terrain);
  return {.exact = exact, .area = {0, 0, size, size}, .ground = &ground};
}

TEST(Arrange, WhatItMakesIsSoundAndKeepsEveryInstance) {
  for (const bool exact : {false, true}) {
    for (const std::size_t count : {0, 1, 2, 777, 20000}) {
      Ecosystem eco = with_types(3);
      const auto instances = random_instances(count, 256, 3);
      ASSERT_TRUE(arrange(instances, options(256, exact), eco));
      EXPECT_EQ(check_ecosystem(eco), std::vector<std::string>{});
      EXPECT_EQ(eco.instance_count(), count);
      for (std::uint32_t t = 0; t < 3; ++t)
        EXPECT_EQ(eco.types[t].instances, std::count_if(instances.begin(), instances.end(),
                                                        [&](const Instance& i) { return i.type == t; }));
    }
  }
}

TEST(Arrange, EveryInstanceComesBackWithinTheErrorsThatAreReported) {
  for (const bool exact : {false, true}) {
    Ecosystem eco = with_types(2);
    const auto instances = random_instances(5000, 256, 2);
    ASSERT_TRUE(arrange(instances, options(256, exact), eco));
    std::vector<Double3> stored, meant;
    for (const InstanceBlock& b : eco.blocks)
      for (std::size_t i = b.first; i < b.first + b.count; ++i) {
        const Instance s = instance_of(eco, b, i);
        stored.push_back(s.position);
      }
    for (const Instance& i : instances) meant.push_back(i.position);
    const auto by_x = [](const Double3& a, const Double3& b) { return a.x < b.x; };
    std::sort(stored.begin(), stored.end(), by_x);
    std::sort(meant.begin(), meant.end(), by_x);
    double worst = 0;
    for (std::size_t i = 0; i < meant.size(); ++i) worst = std::max(worst, distance(stored[i], meant[i]));
    EXPECT_LE(worst, 2e-4);
    EXPECT_LE(eco.position_error, exact ? 1e-5 : 1e-4);
    EXPECT_LE(eco.rotation_error, exact ? 5e-7 : k_packed_rotation_error);
    EXPECT_LE(eco.scale_error, exact ? 1e-7 : 1.0 / 65535);
  }
}

TEST(Arrange, EveryFootIsOnTheGroundWithinAHundredThousandthOfItsSize) {
  const TerrainGround ground(k_terrain);
  // Few over a wide ground and many on a little one: blocks are cut where rounding would show.
  for (const auto& [count, size] : {std::pair(10, 256.0), std::pair(3000, 256.0), std::pair(3000, 0.1)}) {
    for (const bool exact : {false, true}) {
      Ecosystem eco = with_types(1);
      eco.types[0].bounds = {{-0.01f, 0, -0.01f}, {0.01f, 0.02f, 0.01f}};  // grass
      ASSERT_TRUE(
          arrange(random_instances(static_cast<std::size_t>(count), size, 1), options(size, exact), eco));
      for (const InstanceBlock& b : eco.blocks)
        for (std::size_t i = b.first; i < b.first + b.count; ++i) {
          const Instance s = instance_of(eco, b, i);
          EXPECT_LE(std::abs(s.position.y - ground.at(s.position.x, s.position.z)->height),
                    1e-5 * s.scale * 0.02);
        }
    }
  }
}

TEST(Arrange, ALeafOwnsWhatIsPlantedInItsPortionAndSubtreesAreRuns) {
  Ecosystem eco = with_types(2);
  ArrangeOptions o = options(256);
  o.depth = 3;
  ASSERT_TRUE(arrange(random_instances(4000, 256, 2), o, eco));
  ASSERT_EQ(eco.boxes.size(), 85u);
  std::map<std::uint32_t, std::pair<std::uint32_t, std::uint32_t>> leaf_of;  // portion -> leaf
  for (std::uint32_t leaf = first_quad_node(3); leaf < 85; ++leaf) {
    const QuadNode& n = eco.boxes[leaf];
    for (std::uint32_t b = n.first_block; b < n.first_block + n.block_count; ++b)
      for (std::uint32_t i = eco.blocks[b].first; i < eco.blocks[b].first + eco.blocks[b].count; ++i) {
        const Double3 p = instance_of(eco, eco.blocks[b], i).position;
        const auto portion = static_cast<std::uint32_t>(p.z / 32) * 8 + static_cast<std::uint32_t>(p.x / 32);
        const auto [at, is_new] = leaf_of.try_emplace(portion, leaf, 0);
        EXPECT_EQ(at->second.first, leaf);
      }
  }
  EXPECT_EQ(leaf_of.size(), 64u);
}

// The oracle of the digest: with the same box test, the hierarchy shows what testing every box shows.
TEST(Arrange, TheHierarchyShowsTheSameAsTestingEveryBlock) {
  Ecosystem eco = with_types(3);
  ArrangeOptions o = options(256);
  o.depth = 4;
  ASSERT_TRUE(arrange(random_instances(6000, 256, 3), o, eco));
  Random random(2);
  for (int view = 0; view < 200; ++view) {
    const Float3 normal{static_cast<float>(random.uniform(-1, 1)),
                        static_cast<float>(random.uniform(-0.3, 0.3)),
                        static_cast<float>(random.uniform(-1, 1))};
    const double offset = random.uniform(-200, 200);
    const auto seen = [&](const FloatBox& b) {
      double most = 0;
      for (int a = 0; a < 3; ++a)
        most += std::max(double{normal[a]} * double{b.min[a]}, double{normal[a]} * double{b.max[a]});
      return most >= offset;
    };
    std::vector<bool> flat(eco.blocks.size()), tree(eco.blocks.size());
    for (std::size_t b = 0; b < flat.size(); ++b) flat[b] = seen(eco.blocks[b].bounds);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> stack{{0, 0}};
    while (!stack.empty()) {
      const auto [level, i] = stack.back();
      stack.pop_back();
      const QuadNode& n = eco.boxes[first_quad_node(level) + i];
      if (n.bounds.empty() || !seen(n.bounds)) continue;
      if (level < eco.depth) {
        for (std::uint32_t c = 0; c < 4; ++c) stack.emplace_back(level + 1, 4 * i + c);
        continue;
      }
      for (std::uint32_t b = n.first_block; b < n.first_block + n.block_count; ++b)
        tree[b] = seen(eco.blocks[b].bounds);
    }
    EXPECT_EQ(tree, flat);
  }
}

TEST(Arrange, WhatDoesNotFit24BytesIsRefusedUnlessExact) {
  Ecosystem eco = with_types(1);
  eco.materials.resize(255);
  EXPECT_FALSE(arrange(random_instances(3, 9, 1), options(9), eco));
  EXPECT_TRUE(arrange(random_instances(3, 9, 1), options(9, true), eco));
  eco.materials.clear();
  auto moving = random_instances(3, 9, 1);
  moving[1].motion = 256;
  EXPECT_FALSE(arrange(moving, options(9), eco));
  ASSERT_TRUE(arrange(moving, options(9, true), eco));
  EXPECT_EQ(check_ecosystem(eco), std::vector<std::string>{});
}

TEST(Arrange, AMillionInOnePointAreAMillion) {
  Ecosystem eco = with_types(1);
  const Instance one{.position = {1, 2, 3}, .on_ground = true};
  ASSERT_TRUE(arrange(std::vector<Instance>(100000, one), options(256), eco));
  EXPECT_EQ(check_ecosystem(eco), std::vector<std::string>{});
  EXPECT_EQ(eco.instance_count(), 100000u);
  EXPECT_EQ(eco.position_error,
            round_up(distance({1, 2, 3}, {1, TerrainGround(k_terrain).at(1, 3)->height, 3})));
}

TEST(Arrange, AxesAreTheNormalsUnderWhereTheyAreStored) {
  const TerrainGround ground(k_terrain);
  for (const bool exact : {false, true}) {
    Ecosystem eco = with_types(2);
    const auto instances = random_instances(20000, 256, 2);
    const auto order = arrange(instances, options(256, exact), eco);
    ASSERT_TRUE(order);
    for (const InstanceBlock& b : eco.blocks)
      for (std::size_t i = b.first; i < b.first + b.count; ++i) {
        const Instance s = instance_of(eco, b, i);
        const Double3 normal = ground.at(s.position.x, s.position.z)->normal;
        EXPECT_LT(distance(rotate(s.rotation, {0, 1, 0}), normal), 1e-6);
        EXPECT_LT(distance(s.position, instances[(*order)[i]].position), 1e-3);
      }
  }
}

TEST(Arrange, WhatFloatsStaysWhereItIsAndTheRestStandsAllTheSame) {
  auto instances = random_instances(2000, 256, 1);
  instances[7].position.y = 123, instances[7].on_ground = false;
  Ecosystem eco = with_types(1);
  const auto order = arrange(instances, options(256), eco);
  ASSERT_TRUE(order);
  const TerrainGround ground(k_terrain);
  for (const InstanceBlock& b : eco.blocks)
    for (std::size_t i = b.first; i < b.first + b.count; ++i) {
      const Double3 p = instance_of(eco, b, i).position;
      EXPECT_NEAR(p.y, (*order)[i] == 7 ? 123 : ground.at(p.x, p.z)->height, 1e-4);
    }
}

TEST(Arrange, TypesWithoutAShapeAreSoundToo) {
  Ecosystem eco = with_types(1);
  eco.types[0].bounds = {};
  ASSERT_TRUE(arrange(random_instances(50, 9, 1), options(9), eco));
  EXPECT_EQ(check_ecosystem(eco), std::vector<std::string>{});
  EXPECT_TRUE(eco.boxes[0].bounds.empty());  // invalid: nothing to be seen below
}

TEST(Arrange, ALeafHoldsAboutAThousand) {
  EXPECT_EQ(usual_depth(0), 0u);
  EXPECT_EQ(usual_depth(2000), 0u);
  EXPECT_EQ(usual_depth(1000000), 5u);
  EXPECT_EQ(usual_depth(std::size_t{1} << 40), k_max_quad_depth);
}

}  // namespace
}  // namespace copse
