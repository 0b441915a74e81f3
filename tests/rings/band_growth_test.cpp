#include "lib/analysis/rings/band_growth.h"

#include "tests/trunk/welded_meshes.h"

#include <set>

#include <gtest/gtest.h>

namespace copse {
namespace {

Bands none_of(const Surface& s) {
  Bands bands;
  bands.band_of.assign(s.triangles.size(), k_none);
  return bands;
}

// Every triangle of a band has all its corners on the band's two rings, and some on each.
void expect_strips(const Surface& s, const Bands& bands) {
  for (std::uint32_t b = 0; b < bands.count(); ++b) {
    const auto low = bands.ring(2 * b), high = bands.ring(2 * b + 1);
    const std::set<std::uint32_t> lows(low.begin(), low.end()), highs(high.begin(), high.end());
    EXPECT_EQ(lows.size(), low.size());
    EXPECT_EQ(highs.size(), high.size());
    for (std::uint32_t i = bands.first_triangle[b]; i < bands.first_triangle[b + 1]; ++i) {
      std::size_t on_low = 0, on_high = 0;
      for (const auto v : s.triangles[bands.triangles[i]])
        on_low += lows.contains(v), on_high += highs.contains(v);
      EXPECT_EQ(on_low + on_high, 3u);
      EXPECT_TRUE(on_low > 0 && on_high > 0);
    }
  }
}

TEST(BandGrowth, ReadsATubeFromItsBorder) {
  const Double3 axis[] = {{0, 0, 0}, {0, 1, 0}, {0.3, 2, 0}, {0.3, 3, 0.5}};
  const double radii[] = {1, 0.9, 0.8, 0.1};
  const Surface s = surface_of(shuffled(tube(axis, radii, 9, false), 1));
  Bands bands = none_of(s);
  BandGrowth growth(s, bands);
  growth.start_at_borders();
  growth.run(false);
  EXPECT_EQ(bands.count(), 3u);
  EXPECT_EQ(bands.triangles.size(), s.triangles.size());
  expect_strips(s, bands);
}

TEST(BandGrowth, ReadsAClosedTubeFromItsCaps) {
  const Double3 axis[] = {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 3, 0}};
  const double radii[] = {1, 1, 1, 1};
  const Surface s = surface_of(tube(axis, radii, 6, true));
  Bands bands = none_of(s);
  BandGrowth growth(s, bands);
  growth.start_at_points(BandGrowth::Points::all);
  growth.run(false);
  EXPECT_EQ(bands.count(), 5u);
  EXPECT_EQ(bands.triangles.size(), s.triangles.size());
}

TEST(BandGrowth, WaitsAtAForkForTheOtherLimb) {
  const WeldedMesh tree = fork_tree({.depth = 1});
  const Surface s = surface_of(tree.mesh);
  Bands bands = none_of(s);
  BandGrowth growth(s, bands);
  growth.start_at_points(BandGrowth::Points::all);  // two fans; what is left of their links is the ring below
  growth.run(false);
  EXPECT_EQ(bands.count(), 3u);
  EXPECT_EQ(bands.triangles.size(), s.triangles.size());
  expect_strips(s, bands);
}

TEST(BandGrowth, ReadsPastLimbsThatGrowOutOfTheBandBeyond) {
  const int seats[] = {1, 2, 5};  // limbs one above the other, and one for itself
  const Surface s = surface_of(shuffled(seated_limbs(8, seats, 3).mesh, 7));
  Bands bands = none_of(s);
  BandGrowth growth(s, bands);
  growth.start_at_borders();
  growth.run(false);
  EXPECT_LT(bands.triangles.size(), s.triangles.size());
  growth.read_past_limbs();
  EXPECT_EQ(bands.triangles.size(), s.triangles.size());
}

TEST(BandGrowth, FindsNothingInsideASheet) {
  TrunkMesh sheet;
  for (int y = 0; y < 12; ++y) {
    for (int x = 0; x < 12; ++x) sheet.positions.push_back({double(x), double(y), 0});
  }
  for (std::uint32_t y = 0; y < 11; ++y) {
    for (std::uint32_t x = 0; x < 11; ++x) {
      const std::uint32_t a = 12 * y + x;
      sheet.triangles.push_back({a, a + 1, a + 13});
      sheet.triangles.push_back({a, a + 13, a + 12});
    }
  }
  const Surface s = surface_of(sheet);
  Bands bands = none_of(s);
  BandGrowth growth(s, bands);
  growth.start_at_borders();
  growth.start_at_points(BandGrowth::Points::all);
  growth.run(true);
  EXPECT_EQ(bands.count(), 0u);
}

TEST(BandGrowth, ReadsAChangeOfSidesOnlyWhenAsked) {
  TrunkMesh mesh;  // six sides below, five above
  std::vector<std::uint32_t> low, high;
  for (int i = 0; i < 6; ++i) {
    mesh.positions.push_back({std::cos(i * 1.0472), 0, std::sin(i * 1.0472)});
    low.push_back(static_cast<std::uint32_t>(i));
  }
  for (int i = 0; i < 5; ++i) mesh.positions.push_back({std::cos(i * 1.2566), 2, std::sin(i * 1.2566)});
  for (std::uint32_t i = 0; i < 5; ++i) {
    mesh.triangles.push_back({i, i + 1, 6 + i});
    mesh.triangles.push_back({i + 1, 6 + (i + 1) % 5, 6 + i});
  }
  mesh.triangles.push_back({5, 0, 6});
  const Surface s = surface_of(mesh);
  for (const bool change : {false, true}) {
    Bands bands = none_of(s);
    BandGrowth growth(s, bands);
    growth.start_at_borders();
    growth.run(change);
    EXPECT_EQ(bands.count(), change ? 1u : 0u);
    expect_strips(s, bands);
  }
}

TEST(BandGrowth, IsSoundOnAnything) {
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    const Surface s = surface_of(random_soup(8 + seed % 30, 4 + seed, seed));
    Bands bands = none_of(s);
    BandGrowth growth(s, bands);
    growth.start_at_borders();
    growth.start_at_points(BandGrowth::Points::all);
    growth.run(false);
    growth.read_past_limbs();
    growth.close_fans();
    growth.fill_collars();
    growth.run(true);
    growth.read_past_limbs();
    expect_strips(s, bands);
  }
}

TEST(BandGrowth, OfALongVineIsLinear) {
  std::vector<Double3> axis;
  std::vector<double> radii;
  for (int i = 0; i < 100000; ++i) axis.push_back({0, 0.1 * i, 0}), radii.push_back(0.05);
  const Surface s = surface_of(tube(axis, radii, 3, false));
  Bands bands = none_of(s);
  BandGrowth growth(s, bands);
  growth.start_at_borders();
  growth.run(false);
  EXPECT_EQ(bands.count(), 99999u);
}

}  // namespace
}  // namespace copse
