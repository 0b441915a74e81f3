#include "lib/analysis/ecosystem/spread.h"

#include "tests/ecosystem/grounds.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

namespace copse {
namespace {

DensityField ramp(std::uint32_t columns, std::uint32_t rows) {
  DensityField f{{0, 0, static_cast<double>(columns), static_cast<double>(rows)}, columns, rows, {}};
  for (std::uint32_t r = 0; r < rows; ++r)
    for (std::uint32_t c = 0; c < columns; ++c) f.weights.push_back(c);
  return f;
}

// By a field alone, on flat ground where everything is allowed.
class Flat {
 public:
  explicit Flat(DensityField field)
      : terrain_(regular_terrain(3, 8, [](double, double) { return 0; })),
        ground_(terrain_),
        test_(rules_, field.area, ground_),
        field_(with_peaks(std::move(field))),
        spreader_(field_) {}
  GroundPlace draw(std::uint64_t i, std::uint64_t n, Random& random) const {
    return spreader_.draw(i, n, test_, random);
  }

 private:
  static DensityField with_peaks(DensityField field) {
    field.peaks.assign(field.weights.size(), 1);
    return field;
  }
  Terrain terrain_;
  TerrainGround ground_;
  PlacementRules rules_;
  PlacementTest test_;
  DensityField field_;
  Spreader spreader_;
};

TEST(Spread, ADensitysHistogramIsReproducedWithinTwoPercent) {
  const DensityField f = ramp(200, 150);
  const Flat spreader(f);
  const std::uint64_t n = 20000;
  std::vector<double> bins(10), wanted(10);
  for (std::uint64_t i = 0; i < n; ++i) {
    Random random = Random(1).fork(i);
    ++bins[static_cast<std::size_t>(spreader.draw(i, n, random).x / 20)];
  }
  for (std::size_t c = 0; c < 200; ++c)
    wanted[c / 20] += static_cast<double>(c) * 150 / f.total() * static_cast<double>(n);
  double off = 0;
  for (std::size_t b = 0; b < 10; ++b) off += std::abs(bins[b] - wanted[b]);
  EXPECT_LT(off / static_cast<double>(n), 0.02);
  EXPECT_EQ(std::accumulate(bins.begin(), bins.end(), 0.0), static_cast<double>(n));
}

TEST(Spread, WhatWeighsNothingStaysEmpty) {
  DensityField f{{0, 0, 8, 8}, 8, 8, std::vector<double>(64)};
  f.weights[19] = 1e-300;
  const Flat spreader(f);
  for (std::uint64_t i = 0; i < 100; ++i) {
    Random random(i);
    const GroundPlace p = spreader.draw(i, 100, random);
    EXPECT_TRUE(p.x >= 3 && p.x <= 4 && p.z >= 2 && p.z <= 3);
  }
  EXPECT_EQ(Spreader({{0, 0, 1, 1}, 1, 1, {0}}).total(), 0);
}

// A uniform field is filled like a jittered grid: no block of it gets much more than its share.
TEST(Spread, AUniformFieldIsFilledMoreEvenlyThanChance) {
  const Flat spreader({{0, 0, 1, 1}, 64, 64, std::vector<double>(64 * 64, 1)});
  std::vector<double> blocks(64);
  for (std::uint64_t i = 0; i < 6400; ++i) {
    Random random = Random(5).fork(i);
    const GroundPlace p = spreader.draw(i, 6400, random);
    ++blocks[static_cast<std::size_t>(p.z * 8) * 8 + static_cast<std::size_t>(p.x * 8)];
  }
  double chi = 0;
  for (const double b : blocks) chi += (b - 100) * (b - 100) / 100;
  EXPECT_LT(chi, 20);  // 63 on average by chance
}

TEST(Spread, PointsKeepASharpRuleInsideACell) {
  const Terrain terrain = regular_terrain(3, 8, [](double, double) { return 0; });
  const TerrainGround ground(terrain);
  ValueMap forbidden{32, 32, std::vector<float>(32 * 32)};
  for (std::size_t i = 0; i < forbidden.values.size(); ++i) forbidden.values[i] = i % 3 == 0 ? 1 : 0;
  PlacementRules rules;
  rules.forbidden = &forbidden;
  const PlantedArea area{0, 0, 8, 8};
  const DensityField f = make_field(PlacementTest(rules, area, ground), 10, 10, Random(1));
  const Spreader spreader(f);
  const PlacementTest test(rules, area, ground);
  for (std::uint64_t i = 0; i < 2000; ++i) {
    Random random = Random(2).fork(i);
    const GroundPlace p = spreader.draw(i, 2000, test, random);
    EXPECT_TRUE(test.weight(p.x, p.z) > 0);
  }
}

// From a map to the points: stripes and a checker finer than the grid, black pixels stay empty.
TEST(Spread, MapsFinerThanTheGridArePlantedPixelByPixel) {
  const Terrain terrain = regular_terrain(3, 64, [](double, double) { return 0; });
  const TerrainGround ground(terrain);
  const PlantedArea area{0, 0, 64, 64};
  const auto spread = [&](std::uint32_t w, auto value) {
    ValueMap map{w, w, std::vector<float>(std::size_t{w} * w)};
    for (std::size_t i = 0; i < map.values.size(); ++i) map.values[i] = value(i % w, i / w);
    const PlacementRules rules{.density = &map};
    const std::uint32_t side = field_side(w, 1, {}, area);
    const DensityField f = make_field(PlacementTest(rules, area, ground), side, side, Random(1));
    const Spreader spreader(f);
    const PlacementTest test(rules, area, ground);
    std::vector<double> counts(3);
    for (std::uint64_t i = 0; i < 20000; ++i) {
      Random random = Random(3).fork(i);
      const GroundPlace p = spreader.draw(i, 20000, test, random);
      ++counts[static_cast<std::size_t>(pixel_at(map, area, p.x, p.z))];
    }
    return counts;
  };
  const auto stripes = spread(1500, [](std::size_t x, std::size_t) { return x % 3; });
  EXPECT_EQ(stripes[0], 0);
  EXPECT_NEAR(stripes[2] / 20000, 2 / 3.0, 0.01);
  const auto checker =
      spread(4096, [](std::size_t x, std::size_t z) { return (x + z) % 2 + (x + z) % 2 * (x % 2); });
  EXPECT_EQ(checker[0], 0);
  EXPECT_NEAR(checker[2] / 20000, 2 / 3.0, 0.01);
}

TEST(Spread, AThinRuleStacksNoPoints) {
  const Terrain terrain = regular_terrain(65, 64, [](double x, double) { return x; });
  const TerrainGround ground(terrain);
  PlacementRules rules;
  rules.altitude = {16.1, 16.11};
  const PlantedArea area{0, 0, 64, 64};
  const DensityField f = make_field(PlacementTest(rules, area, ground), 64, 64, Random(1));
  const Spreader spreader(f);
  const PlacementTest test(rules, area, ground);
  std::set<std::pair<double, double>> places;
  for (std::uint64_t i = 0; i < 5000; ++i) {
    Random random = Random(2).fork(i);
    const GroundPlace p = spreader.draw(i, 5000, test, random);
    EXPECT_TRUE(test.weight(p.x, p.z) > 0);
    places.insert({p.x, p.z});
  }
  EXPECT_EQ(places.size(), 5000u);
}

TEST(Spread, SharesAddUp) {
  EXPECT_EQ(apportion(10, std::vector<double>{1, 1, 1}), (std::vector<std::uint64_t>{4, 3, 3}));
  EXPECT_EQ(apportion(0, std::vector<double>{1, 2}), (std::vector<std::uint64_t>{0, 0}));
  EXPECT_EQ(apportion(7, std::vector<double>{0, 0}), (std::vector<std::uint64_t>{0, 0}));
  EXPECT_EQ(apportion(7, std::vector<double>{0, 1e-9}), (std::vector<std::uint64_t>{0, 7}));
  EXPECT_TRUE(apportion(7, {}).empty());
  const auto many = apportion(1000003, std::vector<double>{0.1, 0.7, 0.05, 0.15});
  EXPECT_EQ(std::accumulate(many.begin(), many.end(), std::uint64_t{0}), 1000003u);
}

TEST(Spread, EveryCellIsInThePieceOfItsMiddle) {
  const DensityField f = ramp(16, 16);
  const Spreader spreader(f);
  EXPECT_EQ(spreader.cells().size(), 15u * 16);  // the first column weighs nothing
  std::uint64_t last = 0;
  std::vector<double> mass(10);
  for (std::size_t c = 0; c < spreader.cells().size(); ++c) {
    const std::uint64_t piece = spreader.piece_of(c, 10);
    EXPECT_GE(piece, last);
    last = piece;
    ASSERT_LT(piece, 10u);
    mass[piece] += f.weights[spreader.cells()[c]];
  }
  for (const double m : mass) EXPECT_NEAR(m, spreader.total() / 10, 15);
}

}  // namespace
}  // namespace copse
