#include "lib/analysis/lod/coupling.h"

#include "lib/analysis/lod/spectrum_builder.h"
#include "lib/formats/random.h"
#include "lib/runtime/levels.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

// A spectrum that loses one triangle a step.
Spectrum countdown(std::uint32_t triangles) {
  SpectrumBuilder b(LodMethod::radii);
  std::vector<std::uint32_t> elements;
  for (std::uint32_t t = 0; t < triangles; ++t) {
    const std::uint32_t v = b.vertex({});
    const std::array<std::uint32_t, 3> corners{v, v, v};
    elements.push_back(b.element(k_none, k_none, std::span(&corners, 1)));
  }
  for (std::uint32_t t = 0; t < triangles; ++t) {
    b.step(0.001 * (t + 1));
    b.remove(elements[t]);
  }
  return b.finish();
}

LodSpectra two_parts(std::uint32_t trunk, std::uint32_t leaves) {
  LodSpectra s;
  s.trunk = countdown(trunk), s.leaves = countdown(leaves);
  return s;
}

double gone(const TriedLevel& level) {
  return static_cast<double>(std::count(level.leaves.begin(), level.leaves.end(), 0));
}

void expect_schedule(const LodSpectra& s, const std::vector<LodLevel>& knots) {
  ASSERT_FALSE(knots.empty());
  EXPECT_EQ(knots.front(), level_at(s, 0, 0));
  for (std::size_t i = 1; i < knots.size(); ++i) {
    EXPECT_GE(knots[i].trunk_steps, knots[i - 1].trunk_steps);
    EXPECT_GE(knots[i].leaf_steps, knots[i - 1].leaf_steps);
    EXPECT_LT(knots[i].triangles, knots[i - 1].triangles);
    EXPECT_GE(knots[i].error, knots[i - 1].error);
  }
}

TEST(Coupling, GoesFromFullDetailToTheCoarsestState) {
  LodSpectra s = two_parts(400, 900);
  couple(s, nullptr);
  expect_schedule(s, s.schedule);
  EXPECT_EQ(s.schedule.back().triangles, 0u);
}

TEST(Coupling, WithoutAPictureBothKeepTheSameShare) {
  LodSpectra s = two_parts(1000, 3000);
  couple(s, nullptr);
  for (const LodLevel& knot : s.schedule) {
    const double trunk = s.trunk.counts[knot.trunk_steps] / 1000.0,
                 leaves = s.leaves.counts[knot.leaf_steps] / 3000.0;
    EXPECT_NEAR(trunk, leaves, 0.01);
  }
}

TEST(Coupling, TakesFromThePartThatThePictureMissesLess) {
  LodSpectra s = two_parts(1000, 1000);
  // The picture wants the trunk: whatever it loses counts a hundred times.
  couple(s, [&](const TriedLevel& l) { return 100.0 * l.trunk_steps + gone(l); });
  const auto& knots = s.schedule;
  expect_schedule(s, knots);
  const auto half =
      std::find_if(knots.begin(), knots.end(), [](const LodLevel& l) { return l.triangles <= 1200; });
  ASSERT_NE(half, knots.end());
  EXPECT_EQ(s.trunk.counts[knots[1].trunk_steps], 1000u);
  EXPECT_GE(s.trunk.counts[half->trunk_steps], 800u) << "but the leaves keep half of their share";
}

// Leaves that become one, two at a time; every element must be gone when the trunk has taken so many steps:
// when it is nearly gone, but some far earlier.
struct Crown {
  Spectrum spectrum;
  std::vector<std::uint32_t> held_until;  // by the first vertex's x, which names the element
};

Crown crown(std::uint32_t leaves, std::uint32_t trunk_steps, std::uint64_t seed) {
  Random random(seed);
  Crown out;
  SpectrumBuilder b(LodMethod::collapse);
  std::vector<std::uint32_t> alive;
  const auto add = [&](double height) {
    const auto number = static_cast<float>(out.held_until.size());
    const std::uint32_t v = b.vertex({{number, 0, 0}, {}, {}});
    const std::array<std::uint32_t, 3> corners{v, v, v};
    const bool early = random.chance(0.05);
    const double share = early ? random.uniform(0.05, 0.5) : height * random.uniform(0.9, 1.1);
    out.held_until.push_back(1 + static_cast<std::uint32_t>(share * trunk_steps));
    alive.push_back(b.element(k_none, k_none, std::span(&corners, 1)));
  };
  for (std::uint32_t l = 0; l < leaves; ++l) add(0.9);
  while (alive.size() > 1) {
    b.step(1.0 / static_cast<double>(alive.size()));
    const auto at = static_cast<std::size_t>(random.uniform() * static_cast<double>(alive.size() - 1));
    for (int i = 0; i < 2; ++i) {
      b.remove(alive[at]);
      alive.erase(alive.begin() + static_cast<std::ptrdiff_t>(at));
    }
    add(alive.empty() ? 2 : 1);
  }
  out.spectrum = b.finish();
  return out;
}

// Of the spectrum's own elements, however they are sorted.
std::vector<std::uint32_t> held_until(const Spectrum& s, const Crown& crown) {
  std::vector<std::uint32_t> out;
  for (std::size_t e = 0; e < s.elements.size(); ++e)
    out.push_back(crown.held_until[static_cast<std::size_t>(
        s.vertices[s.triangles[s.first_triangle[e]][0]].position.x)]);
  return out;
}

auto held(std::vector<std::uint32_t> until) {
  return [until](std::uint32_t leaf, std::uint32_t trunk_steps) { return until[leaf] <= trunk_steps; };
}

LodSpectra with(std::uint32_t trunk, const Crown& crown) {
  LodSpectra s;
  s.trunk = countdown(trunk), s.leaves = crown.spectrum;
  return s;
}

void expect_nothing_floats(const LodSpectra& s, const Crown& crown) {
  const std::vector<std::uint32_t> until = held_until(s.leaves, crown);
  for (std::uint32_t triangles = s.schedule[0].triangles; triangles >= s.schedule.back().triangles;
       --triangles) {
    const LodLevel level = level_of_triangles(s, triangles);
    ASSERT_LE(level.triangles, triangles);
    for (std::size_t e = 0; e < until.size(); ++e) {
      const SpectrumElement& x = s.leaves.elements[e];
      if (x.birth <= level.leaf_steps && level.leaf_steps < x.death) {
        ASSERT_GT(until[e], level.trunk_steps) << e << " of " << triangles;
      }
    }
  }
}

TEST(Coupling, AtNoLevelBetweenAnyKnotsDoesALeafFloat) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const Crown leaves = crown(300, 400, seed);
    for (const bool picture : {false, true}) {
      LodSpectra s = with(400, leaves);
      const std::vector<std::uint32_t> until = held_until(s.leaves, leaves);
      // The picture would rather lose the trunk.
      LevelError error = [&](const TriedLevel& l) { return gone(l); };
      couple(s, picture ? error : LevelError{}, {.floats_by = held(until)});
      expect_schedule(s, s.schedule);
      expect_nothing_floats(s, leaves);
      EXPECT_EQ(s.schedule.back().triangles, 1u) << "the last leaf stays as long as the trunk does";
    }
  }
}

TEST(Coupling, AFewLeavesThatWouldFloatDoNotTakeTheCrownAlong) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const Crown leaves = crown(1000, 1000, seed);
    LodSpectra s = with(1000, leaves);
    const std::vector<std::uint32_t> until = held_until(s.leaves, leaves);
    couple(s, nullptr, {.floats_by = held(until)});
    for (const LodLevel& knot : s.schedule) {
      if (knot.triangles < 150) continue;
      EXPECT_GE(s.leaves.counts[knot.leaf_steps], knot.triangles / 4) << "of " << knot.triangles;
    }
  }
}

TEST(Coupling, WhereNothingFloatsTheLeavesKeepTheirOrder) {
  const Crown leaves = crown(300, 400, 1);
  LodSpectra s = with(400, leaves);
  couple(s, nullptr, {.floats_by = [](std::uint32_t, std::uint32_t) { return false; }});
  EXPECT_TRUE(std::ranges::equal(s.leaves.elements, leaves.spectrum.elements));
}

TEST(Coupling, ALeafThatNeverGoesStopsTheTrunk) {
  LodSpectra s = two_parts(100, 1);
  SpectrumBuilder b(LodMethod::collapse);
  const std::uint32_t v = b.vertex({});
  const std::array<std::uint32_t, 3> corners{v, v, v};
  b.element(k_none, k_none, std::span(&corners, 1));
  s.leaves = b.finish();
  couple(s, nullptr, {.floats_by = held({60})});
  EXPECT_LT(s.schedule.back().trunk_steps, 60u);
  EXPECT_GT(s.schedule.back().trunk_steps, 20u);
}

TEST(Coupling, StopsAtTheLeastNumberOfTriangles) {
  LodSpectra s = two_parts(400, 900);
  couple(s, nullptr, {.min_triangles = 200});
  EXPECT_GE(s.schedule.back().triangles, 200u);
}

TEST(Coupling, OnePartAloneHasAScheduleToo) {
  LodSpectra s;
  s.leaves = countdown(100);
  couple(s, nullptr);
  expect_schedule(s, s.schedule);
  EXPECT_EQ(s.schedule.back().triangles, 0u);
  LodSpectra none;
  couple(none, nullptr);
  EXPECT_EQ(none.schedule.size(), 1u);
}

TEST(Coupling, FindsTheFirstStepWithSoManyTriangles) {
  const Spectrum s = countdown(10);
  EXPECT_EQ(step_with(s, 10), 0u);
  EXPECT_EQ(step_with(s, 7), 3u);
  EXPECT_EQ(step_with(s, 0), 10u);
}

}  // namespace
}  // namespace copse
