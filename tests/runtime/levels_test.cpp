#include "lib/runtime/levels.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

namespace copse {
namespace {

// n elements of `triangles` triangles each, two become one in every step; materials alternate.
Spectrum pairs(std::uint32_t n, std::uint32_t triangles, bool mixed = false) {
  struct Life {
    std::uint32_t birth, death;
  };
  std::vector<Life> lives(n, {0, k_none});
  for (std::uint32_t step = 1; step < n; ++step) {
    lives[2 * step - 2].death = step, lives[2 * step - 1].death = step;
    lives.push_back({step, k_none});
  }
  std::stable_sort(lives.begin(), lives.end(), [](const Life& a, const Life& b) {
    return a.death != b.death ? a.death > b.death : a.birth < b.birth;
  });
  std::vector<SpectrumElement> elements;
  std::vector<std::uint32_t> first{0}, counts(n, 0);
  std::vector<std::array<std::uint32_t, 3>> corners;
  for (std::size_t e = 0; e < lives.size(); ++e) {
    elements.push_back({lives[e].birth, lives[e].death, static_cast<std::uint32_t>(e % 2), k_none});
    const std::uint32_t own = mixed && e % 3 == 0 ? 1 : triangles;
    for (std::uint32_t t = 0; t < own; ++t) {
      const auto v = static_cast<std::uint32_t>(3 * corners.size());
      corners.push_back({v, v + 1, v + 2});
    }
    first.push_back(static_cast<std::uint32_t>(corners.size()));
    for (std::uint32_t step = lives[e].birth; step < std::min(lives[e].death, n); ++step) counts[step] += own;
  }
  Spectrum s;
  s.vertices = std::vector<SpectrumVertex>(3 * corners.size());
  s.elements = elements, s.first_triangle = first, s.triangles = corners, s.counts = counts;
  s.errors = std::vector<float>(n, 0.0f);
  return s;
}

std::multiset<std::uint32_t> expected(const Spectrum& s, std::uint32_t step) {
  std::multiset<std::uint32_t> out;
  for (std::size_t e = 0; e < s.elements.size(); ++e) {
    if (s.elements[e].birth > step || step >= s.elements[e].death) continue;
    for (std::uint32_t t = s.first_triangle[e]; t < s.first_triangle[e + 1]; ++t)
      out.insert(s.triangles[t].begin(), s.triangles[t].end());
  }
  return out;
}

TEST(Levels, ExtractionGivesExactlyWhatIsAlive) {
  struct Case {
    std::uint32_t elements, triangles, stride;
    bool mixed;
  };
  // Few elements, and many: more than are copied at once.
  for (const auto& [elements, triangles, stride, mixed] : {Case{300, 1, 13, false},
                                                           {300, 2, 13, false},
                                                           {300, 2, 13, true},
                                                           {300, 5, 13, true},
                                                           {3000, 1, 499, false},
                                                           {3000, 2, 499, true}}) {
    const Spectrum s = pairs(elements, triangles, mixed);
    const LevelExtractor extractor(s);
    std::vector<std::uint32_t> out(extractor.capacity());
    for (std::uint32_t step = 0; step <= s.steps(); step += stride) {
      const std::size_t n = extractor.extract(step, out);
      ASSERT_EQ(n, 3 * s.counts[step]);
      EXPECT_EQ(std::multiset<std::uint32_t>(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(n)),
                expected(s, step));
    }
  }
}

TEST(Levels, MaterialsTogetherAreTheWhole) {
  const Spectrum s = pairs(100, 2);
  const LevelExtractor extractor(s);
  std::vector<std::uint32_t> whole(extractor.capacity()), part(extractor.capacity());
  const std::size_t n = extractor.extract(40, whole);
  std::size_t at = 0;
  for (const std::uint32_t m : extractor.materials()) {
    const std::size_t k = extractor.extract(40, m, part);
    EXPECT_TRUE(std::equal(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(k),
                           whole.begin() + static_cast<std::ptrdiff_t>(at)));
    at += k;
  }
  EXPECT_EQ(at, n);
  EXPECT_EQ(extractor.extract(40, 77, part), 0u);
}

TEST(Levels, BeyondTheLastStepIsTheLastStep) {
  const Spectrum s = pairs(10, 2);
  const LevelExtractor extractor(s);
  std::vector<std::uint32_t> out(extractor.capacity());
  EXPECT_EQ(extractor.extract(1000, out), 6u);
  EXPECT_EQ(extractor.extract(0, std::span<std::uint32_t>{}), 0u);  // no room: nothing is written
  EXPECT_EQ(LevelExtractor(Spectrum{}).capacity(), 0u);
}

LodSpectra two() {
  LodSpectra s;
  s.trunk = pairs(101, 2), s.leaves = pairs(201, 2);
  // The leaves err by 0.1 m in the end, the trunk by 0.01 m a step.
  std::vector<float> trunk, leaves;
  for (int n = 0; n <= 100; ++n) trunk.push_back(0.01f * static_cast<float>(n));
  for (int n = 0; n <= 200; ++n) leaves.push_back(0.0005f * static_cast<float>(n));
  s.trunk.errors = trunk, s.leaves.errors = leaves;
  const auto level = [&](std::uint32_t n, std::uint32_t m, float error, float distance) {
    return LodLevel{n, m, s.trunk.counts[n] + s.leaves.counts[m], error, distance};
  };
  s.schedule = {level(0, 0, 0, 1), level(20, 120, 0.2f, 2), level(100, 200, 1, 8)};
  s.discrete = {level(10, 60, 0.1f, 100), level(20, 120, 0.2f, 500), level(100, 200, 1, 1500)};
  s.near = 10, s.far = 100, s.hysteresis = 0.1f;
  return s;
}

TEST(Levels, ByTrianglesNeverMoreThanAsked) {
  const LodSpectra s = two();
  std::uint32_t before = 1u << 30;
  for (std::uint32_t triangles = 604; triangles > 4; triangles -= 3) {
    const LodLevel l = level_of_triangles(s, triangles);
    ASSERT_LE(l.triangles, triangles);
    ASSERT_GE(l.triangles + 8, triangles);  // and not many fewer
    EXPECT_EQ(l.triangles, s.trunk.counts[l.trunk_steps] + s.leaves.counts[l.leaf_steps]);
    ASSERT_LE(l.triangles, before);
    before = l.triangles;
  }
  EXPECT_EQ(level_of_triangles(s, 0), s.schedule.back());
  EXPECT_EQ(level_of_triangles(s, 1u << 30), s.schedule.front());
}

TEST(Levels, ByErrorTheCoarsestThatIsWithin) {
  const LodSpectra s = two();
  EXPECT_EQ(level_of_error(s, 0), s.schedule[0]);
  EXPECT_EQ(level_of_error(s, 9), s.schedule[2]);
  for (const double error : {0.005, 0.1, 0.2, 0.5, 0.77}) {
    const LodLevel l = level_of_error(s, error);
    EXPECT_LE(l.error, error);
    EXPECT_EQ(l.error, std::max(s.trunk.errors[l.trunk_steps], s.leaves.errors[l.leaf_steps]));
    EXPECT_GT(l.error, error - 0.011) << "not where a knot is, but where the error is";
  }
}

TEST(Levels, OfOnePartAloneTheCountIsThatOfWhatIsDrawn) {
  LodSpectra s = two();
  s.leaves = {};
  for (LodLevel& knot : s.schedule) knot.leaf_steps = 0, knot.triangles = s.trunk.counts[knot.trunk_steps];
  s.trunk.counts = [&] {  // not in proportion to the steps
    std::vector<std::uint32_t> counts(s.trunk.counts.begin(), s.trunk.counts.end());
    for (std::size_t n = 1; n < 15; ++n) counts[n] = counts[20];
    return counts;
  }();
  for (std::uint32_t triangles = 200; triangles > 2; triangles -= 7) {
    const LodLevel l = level_of_triangles(s, triangles);
    EXPECT_EQ(l.triangles, s.trunk.counts[l.trunk_steps]);
    EXPECT_LE(l.triangles, triangles);
  }
}

TEST(Levels, ByDistanceFallsFromFullToCoarsest) {
  const LodSpectra s = two();
  EXPECT_EQ(level_of_distance(s, 0), s.schedule.front());
  EXPECT_EQ(level_of_distance(s, std::nan("")), s.schedule.front());
  EXPECT_LE(level_of_distance(s, 1e9).triangles, 604u / 100);
  EXPECT_EQ(level_of_distance(s, 1e9), level_of_distance(s, 100)) << "beyond far nothing changes";
  std::uint32_t before = 1u << 30;
  for (double d = 10; d < 100; d += 3) {
    EXPECT_LE(level_of_distance(s, d).triangles, before);
    before = level_of_distance(s, d).triangles;
  }
}

TEST(Levels, HysteresisHoldsTheLevelInItsBand) {
  const LodSpectra s = two();  // borders at 100, 500, 1500; 10 percent
  EXPECT_EQ(choose_discrete(s, 50, 0), 0u);
  EXPECT_EQ(choose_discrete(s, 109, 0), 0u);  // going away: not before 110
  EXPECT_EQ(choose_discrete(s, 111, 0), 1u);
  EXPECT_EQ(choose_discrete(s, 91, 1), 1u);  // coming back: not before 90
  EXPECT_EQ(choose_discrete(s, 89, 1), 0u);
  EXPECT_EQ(choose_discrete(s, 1e6, 0), 3u);
  EXPECT_EQ(choose_discrete(s, 0, 3), 0u);
  EXPECT_EQ(choose_discrete(s, 600, 99), 2u);  // no such level: that of the borders
  EXPECT_EQ(choose_discrete(s, std::nan(""), 2), 0u);
}

TEST(Levels, ContinuousDetailHoldsStillWhileTheCameraSways) {
  const LodSpectra s = two();  // 10 percent
  double held = held_distance(s, 50, std::nan(""));
  EXPECT_EQ(held, 50);
  for (const double d : {52.0, 46.0, 54.9, 45.1}) EXPECT_EQ(held = held_distance(s, d, held), 50) << d;
  EXPECT_NEAR(held = held_distance(s, 66, held), 60, 1e-5);  // going away it trails by the band
  EXPECT_NEAR(held = held_distance(s, 58, held), 60, 1e-5);
  EXPECT_NEAR(held = held_distance(s, 45, held), 50, 1e-5);  // and coming back
  EXPECT_EQ(held_distance(s, 0, held), 0);
  EXPECT_EQ(held_distance(s, 7, 0), 7);
  EXPECT_TRUE(std::isnan(held_distance(s, std::nan(""), held)));
  LodSpectra none = s;
  none.hysteresis = 0;
  EXPECT_EQ(held_distance(none, 50.5, 50), 50.5);
}

TEST(Levels, TheImpostorHasTheSameHysteresis) {
  const LodSpectra s = two();
  EXPECT_FALSE(choose_impostor(s, 2000, 2150, false));
  EXPECT_TRUE(choose_impostor(s, 2000, 2250, false));
  EXPECT_TRUE(choose_impostor(s, 2000, 1850, true));
  EXPECT_FALSE(choose_impostor(s, 2000, 1750, true));
  EXPECT_FALSE(choose_impostor(s, 2000, std::nan(""), true));
}

TEST(Levels, WithoutAScheduleTheDiscreteLevelsAreChosenFrom) {
  LodSpectra s = two();
  const LodLevel full = s.schedule.front();
  s.schedule.clear();
  EXPECT_EQ(full_detail(s).triangles, full.triangles);
  EXPECT_EQ(level_of_triangles(s, full.triangles), full_detail(s));
  EXPECT_EQ(level_of_triangles(s, full.triangles - 1), s.discrete[0]);
  EXPECT_EQ(level_of_triangles(s, s.discrete[1].triangles), s.discrete[1]);
  EXPECT_EQ(level_of_triangles(s, 0), s.discrete[2]);
  EXPECT_EQ(level_of_error(s, 0.05), full_detail(s));
  EXPECT_EQ(level_of_error(s, 0.5), s.discrete[1]);
  EXPECT_EQ(level_of_distance(s, 99), full_detail(s));
  EXPECT_EQ(level_of_distance(s, 600), s.discrete[1]);
}

TEST(Levels, WithoutAnyLevelsThereIsFullDetail) {
  EXPECT_EQ(level_of_triangles({}, 5), LodLevel{});
  EXPECT_EQ(level_of_error({}, 5), LodLevel{});
  EXPECT_EQ(choose_discrete({}, 5, 0), 0u);
}

}  // namespace
}  // namespace copse
