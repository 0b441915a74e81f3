#include "lib/analysis/volumes/fit_volumes.h"

#include "lib/analysis/volumes/certify.h"
#include "tests/volumes/batteries.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

namespace copse {
namespace {

using Points = std::vector<Double3>;

std::vector<FittedVolume> fit_all(const Points& points, const FitOptions& options = {}) {
  const auto fitter = VolumeFitter::make(points);
  EXPECT_TRUE(fitter) << fitter.error().what;
  std::vector<FittedVolume> out;
  for (const FitMethod& m : fit_methods()) {
    auto v = fitter->fit(m, options);
    EXPECT_TRUE(v) << name_of(m.kind) << " " << m.name;
    if (v) out.push_back(std::move(*v));
  }
  return out;
}
const FittedVolume& of(const std::vector<FittedVolume>& all, VolumeKind kind, std::string_view method) {
  return *std::find_if(all.begin(), all.end(), [&](const FittedVolume& v) {
    return v.method.kind == kind && v.method.name == method;
  });
}

TEST(FitVolumes, EveryKindHasAMethodThatSearchesAndNamesAreUnique) {
  std::set<std::pair<VolumeKind, std::string_view>> names;
  std::set<VolumeKind> searched;
  for (const FitMethod& m : fit_methods()) {
    EXPECT_TRUE(names.insert({m.kind, m.name}).second) << m.name;
    EXPECT_LE(m.name.size(), 23u);  // a file holds 24 characters
    if (m.least) searched.insert(m.kind);
  }
  for (const auto& [kind, name] : names) EXPECT_TRUE(searched.contains(kind)) << name_of(kind);
}

TEST(FitVolumes, NoPointOfTheWholeBatteryIsOutsideAnyVolumeAsStored) {
  for (const BatterySet& set : battery::all()) {
    for (const FittedVolume& v : fit_all(set.points)) {
      EXPECT_TRUE(v.certified) << set.name << ": " << name_of(v.method.kind) << " " << v.method.name;
      EXPECT_TRUE(certify(v.volume, set.points).holds())
          << set.name << ": " << name_of(v.method.kind) << " " << v.method.name;
      EXPECT_LE(v.lower_bound, v.measures.volume)
          << set.name << ": " << name_of(v.method.kind) << " " << v.method.name;
    }
  }
}

TEST(FitVolumes, TheSearchIsNeverWorseThanTheQuickMethods) {
  for (const BatterySet& set : battery::all()) {
    const auto all = fit_all(set.points);
    for (const FittedVolume& searched : all) {
      if (!searched.method.least || searched.method.kind == VolumeKind::kdop) continue;
      for (const FittedVolume& quick : all) {
        if (quick.method.kind != searched.method.kind) continue;
        double size = 0;
        for (const Double3& p : set.points) size = std::max(size, length(p));
        EXPECT_LE(searched.measures.volume, quick.measures.volume * (1 + 1e-5) + 1e-6 * size * size * size)
            << set.name << ": " << name_of(searched.method.kind) << " " << quick.method.name;
      }
    }
  }
}

TEST(FitVolumes, KnownVolumesAreFound) {
  const auto cube = fit_all(battery::cube());
  EXPECT_NEAR(of(cube, VolumeKind::sphere, "minimal").measures.volume, 2.720699046, 1e-6);
  EXPECT_NEAR(of(cube, VolumeKind::obb, "minimal").measures.volume, 1, 1e-6);
  EXPECT_LE(of(cube, VolumeKind::capsule, "minimal").measures.volume, 2.63945038 * 1.001);
  EXPECT_LE(of(cube, VolumeKind::lozenge, "minimal").measures.volume, 2.444035895 * 1.002);
  const auto torus = fit_all(battery::torus(40, 32, 0.5, 0.125));
  EXPECT_NEAR(of(torus, VolumeKind::sphere, "minimal").measures.volume, 1.022653859, 1e-6);
  EXPECT_LE(of(torus, VolumeKind::obb, "minimal").measures.volume, 0.388220379 * 1.0001);
  EXPECT_LE(of(torus, VolumeKind::lozenge, "minimal").measures.volume, 0.35435676 * 1.002);
  const auto line = fit_all(battery::line(50, {0.1, 0.2, 0.3}));
  EXPECT_NEAR(of(line, VolumeKind::sphere, "minimal").measures.volume, 3226.851027, 1e-2);
}

TEST(FitVolumes, NotOneByteDependsOnTheOrderOrRepetitionOfThePoints) {
  Points points = battery::turned(battery::twig(10));
  const auto before = fit_all(points);
  Random random(1);
  random.shuffle(std::span(points));
  points.insert(points.end(), points.begin(), points.begin() + 50);
  const auto after = fit_all(points);
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (!before[i].method.least) continue;  // a mean depends on repetition, and sums on the order
    EXPECT_EQ(before[i].volume, after[i].volume)
        << name_of(before[i].method.kind) << " " << before[i].method.name;
    EXPECT_EQ(before[i].lower_bound, after[i].lower_bound);
  }
}

TEST(FitVolumes, ScaleAndPlaceChangeNothingButRounding) {
  const Points points = battery::turned(battery::cloud(200, {1, 2, 4}, 3));
  const auto base = fit_all(points);
  for (const double scale : {0x1p-90, 0x1p90}) {
    const auto scaled = fit_all(battery::scaled(points, scale));
    for (std::size_t i = 0; i < base.size(); ++i) {
      EXPECT_NEAR(scaled[i].measures.volume / (scale * scale * scale) / base[i].measures.volume, 1, 1e-5)
          << name_of(base[i].method.kind) << " " << base[i].method.name << " " << scale;
    }
  }
  const auto moved = fit_all(battery::scaled(points, 1, {1e4, -1e4, 1e4}));
  for (std::size_t i = 0; i < base.size(); ++i) {
    EXPECT_NEAR(moved[i].measures.volume / base[i].measures.volume, 1, 1e-2)
        << name_of(base[i].method.kind) << " " << base[i].method.name;
  }
}

TEST(FitVolumes, LowerBoundsAreSharedWithinAKind) {
  auto all = fit_all(battery::cube());
  share_lower_bounds(all);
  double bound = -1;
  for (const FittedVolume& v : all) {
    if (v.method.kind != VolumeKind::obb) continue;
    if (bound >= 0) {
      EXPECT_EQ(v.lower_bound, bound);
    }
    bound = v.lower_bound;
  }
}

TEST(FitVolumes, WhatIsNotFiniteOrNothingIsRefused) {
  EXPECT_FALSE(VolumeFitter::make(Points{}));
  EXPECT_FALSE(VolumeFitter::make(Points{{0, 0, 0}, {0, std::numeric_limits<double>::quiet_NaN(), 0}}));
}

TEST(FitVolumes, CoordinatesBeyondFloat32GiveNoVolume) {
  const Points huge = battery::scaled(battery::cube(), 1e200);
  const auto fitter = VolumeFitter::make(huge);
  ASSERT_TRUE(fitter);
  for (const FitMethod& m : fit_methods()) EXPECT_FALSE(fitter->fit(m)) << m.name;
}

}  // namespace
}  // namespace copse
